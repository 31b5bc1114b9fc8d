#include "report/report_text.h"

#include <gmock/gmock.h>

#include "report/sample_report.h"
#include "report/text_table.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::sample_report;
using ::testing::StartsWith;

TEST(TextTable, ByHand) {
  TextTable table;
  table.add({"a", "12", "x"});
  table.add({"long", "3"});
  EXPECT_EQ(table.str(), "  a     12  x\n  long   3\n");
}

TEST(TextTable, CountsCharactersNotBytes) {
  TextTable table;
  table.add({"\xC3\xA4", "x"});  // one letter, two bytes
  table.add({"b", "y"});
  EXPECT_EQ(table.str(0), "\xC3\xA4  x\nb  y\n");
}

TEST(ReportText, SaysWhatMatters) {
  const std::string text = to_text(sample_report());
  EXPECT_THAT(text, StartsWith("centaur  (skinforge 9.9.9)\n"));
  EXPECT_THAT(text, HasSubstr("replace Neck1 <- Spine of man, scaled by 1.25"));
  EXPECT_THAT(text, HasSubstr("ring zip: 60 faces (51 quads, 9 triangles), borders of 24 + 18"));
  EXPECT_THAT(text, HasSubstr("24 and 18 border edges are no tube of quads"));
  EXPECT_THAT(text, HasSubstr("with Idle"));
  EXPECT_THAT(text, HasSubstr("horse: Neck1: replaced by operation 0"));
  EXPECT_THAT(text, HasSubstr("! op 0: the loops are 0.4 m apart [placement-far]"));
  EXPECT_THAT(text, HasSubstr("centaur.glb  1.23 MB"));
}

TEST(ReportText, MarksWhatDeservesALook) {
  Report report = sample_report();
  EXPECT_THAT(to_text(report), HasSubstr("sound"));
  EXPECT_THAT(to_text(report), HasSubstr("Hand.L turns 1.21 times as fast"));
  report.junctions[0].boundary_edges = 3;
  report.clips[0].turn_ratio = 1.05;
  EXPECT_THAT(to_text(report), HasSubstr("! 3 open edges"));
  EXPECT_THAT(to_text(report), Not(HasSubstr("times as fast")));
}

TEST(ReportText, LongListsAreCut) {
  Report report = sample_report();
  for (int i = 0; i < 20; ++i)
    report.ledger.push_back(
        {LedgerKind::Joint, "horse", "Ear" + std::to_string(i), LedgerState::Dropped, {}, "gone"});
  EXPECT_THAT(to_text(report), HasSubstr("Ear7 and 12 more: gone"));
}

TEST(ReportText, EmptyReportIsShort) {
  EXPECT_THAT(to_text(Report{}), Not(HasSubstr("junctions")));
}

TEST(ReportText, TimingsCostliestFirst) {
  const Timings timings{
      1.5, 2.5, 250'000'000, {{"import", "horse", "run", 0.25, 0.5, 1}, {"field", "", "run", 1, 2, 1}}};
  const std::string text = to_text(timings);
  EXPECT_LT(text.find("field"), text.find("import"));
  EXPECT_THAT(text, HasSubstr("250.00 MB at most"));
}

}  // namespace
}  // namespace skinforge
