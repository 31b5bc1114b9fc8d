#include "io/dae_nodes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/error.h"
#include "base/limits.h"

namespace skinforge {
namespace {

std::string refusal(const std::string& text) {
  try {
    check_dae_nodes(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "nothing was refused";
}

/// A library in which each node holds the one below it twice: the last becomes 2^(levels + 1) - 1 nodes.
std::string doubling(int levels) {
  std::string text = "<node id=\"n0\"/>";
  for (int i = 1; i <= levels; ++i) {
    const std::string name = fmt::format("<instance_node url=\"#n{}\"/>", i - 1);
    text += fmt::format("<node id=\"n{}\">{}{}</node>", i, name, name);
  }
  return text;
}

TEST(DaeNodes, RefusesANodeAboveItself) {
  const std::string message = "COLLADA: node \"a\" is its own ancestor";
  EXPECT_EQ(refusal("<node id=\"a\"><instance_node url=\"#a\"/></node>"), message);
  EXPECT_EQ(refusal("<node id=\"a\"><node id=\"b\" name='>'>\n<instance_node url=\"#a\"/></node></node>"),
            message);
  EXPECT_EQ(refusal("<node id=\"a\"><instance_node url=\"#b\"/></node>"
                    "<node id=\"b\"><instance_node url=\"#a\"/></node>"),
            message);
}

TEST(DaeNodes, LeavesAloneWhatHasAnEnd) {
  for (const char* text :
       {"<node id=\"a\"></node><instance_node url=\"#a\"/>",
        "<node id=\"a\"/><node id=\"b\"><instance_node url=\"#a\"/></node>",
        "<node id=\"a\"><!-- <instance_node url=\"#a\"/> --></node>",
        "<node id=\"a\"><![CDATA[ <instance_node url=\"#a\"/> ]]></node>",
        "<node id=\"a\"><instance_node url=\"other.dae#a\"/></node>",
        "<node id=\"a\"><instance_node url=\"#c\"/></node>", "<node><instance_node url=\"#\"/></node>",
        "</node></node><node_list id=\"a\">", "<node", "<!--", "<", ""})
    EXPECT_EQ(refusal(text), "nothing was refused") << text;
}

TEST(DaeNodes, AreAsManyAsAScenesAtMost) {
  EXPECT_EQ(refusal(doubling(15)), "nothing was refused");  // 65535 nodes
  EXPECT_EQ(refusal(doubling(16)),
            "COLLADA: node \"n16\" becomes 131071 nodes, the limit is 65536; --limit nodes=N raises it");
  EXPECT_THAT(refusal(doubling(200)), ::testing::HasSubstr("131071"));
}

}  // namespace
}  // namespace skinforge
