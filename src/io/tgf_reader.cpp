#include "io/tgf_reader.h"

#include <map>

#include "io/line_reader.h"

namespace skinforge {
namespace {

class TgfParser {
 public:
  explicit TgfParser(std::string_view text) : lines_(text) {}

  BoneGraph parse() {
    bool in_bones = false;
    while (lines_.find_line()) {
      const std::string_view word = lines_.next_word();
      if (word.starts_with('#') && in_bones) break;  // sections of other tools: point handles, pseudo edges
      if (word.starts_with('#'))
        in_bones = true;
      else if (in_bones)
        read_bone(word);
      else
        read_joint(word);
    }
    return finish();
  }

 private:
  void read_joint(std::string_view word) {
    const auto index = lines_.number<std::int32_t>(word, "the number of a joint");
    Vec3 position;
    for (double& coordinate : position) coordinate = lines_.read<double>("a coordinate");
    if (!position.allFinite()) lines_.fail("a coordinate is not finite");
    if (index < 1) lines_.fail(fmt::format("joint {}; joints count from 1", index));
    if (!joints_.emplace(index, position).second) lines_.fail(fmt::format("joint {} is given twice", index));
  }

  void read_bone(std::string_view word) {
    const auto source = lines_.number<std::int32_t>(word, "the source joint of a bone");
    const auto end = lines_.read<std::int32_t>("the end joint of a bone");
    for (const std::int32_t joint : {source, end})
      if (!joints_.contains(joint)) lines_.fail(fmt::format("there is no joint {}", joint));
    if (source == end) lines_.fail(fmt::format("a bone from joint {} to itself", source));
    graph_.bones.push_back({source - 1, end - 1});
  }

  BoneGraph finish() {
    if (graph_.bones.empty()) lines_.fail("a skeleton without bones");
    for (const auto& [index, position] : joints_) {
      if (index != static_cast<std::int32_t>(graph_.joints.size()) + 1)
        lines_.fail(fmt::format("joint {} is missing", graph_.joints.size() + 1));
      graph_.joints.push_back(position);
    }
    return std::move(graph_);
  }

  LineReader lines_;
  std::map<std::int32_t, Vec3> joints_;  ///< by the number in the file
  BoneGraph graph_;
};

}  // namespace

BoneGraph read_tgf(const InputFile& file) {
  return with_context(printable(file.path), [&] {
    return TgfParser({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()}).parse();
  });
}

}  // namespace skinforge
