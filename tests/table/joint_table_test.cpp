// Tables of joint values: reading, and the faults of refused ones.
#include "formats/table/joint_table.h"

#include <gtest/gtest.h>

#include "formats/detect/file_format.h"
#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

std::vector<std::string> names_of(const JointTable& table) {
  std::vector<std::string> out;
  for (const TableColumn& column : table.columns) out.push_back(column.name);
  return out;
}

TEST(JointTable, IsALineOfNamesAndLinesOfNumbers) {
  const Result<JointTable> table = parse_joint_table("time,a,b\n0,1,-2e-1\n0.5,+3,4\n");
  ASSERT_TRUE(table.ok()) << to_line(table.issue());
  EXPECT_EQ(names_of(*table), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table->times_s, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(table->values, (std::vector<double>{1.0, -0.2, 3.0, 4.0}));
  EXPECT_DOUBLE_EQ(table->time_digit_s, 0.1);
}

TEST(JointTable, MayBeWrittenInManyWays) {
  const JointTable plain = *parse_joint_table("t,a,b\n0,1,2\n1,3,4\n");
  for (const char* text :
       {"t;a;b\n0;1;2\n1;3;4\n", "t\ta\tb\n0\t1\t2\n1\t3\t4\n", "t a b\n0 1  2\n 1 3 4 \n", "\xef\xbb\xbft,a,b\r\n0,1,2\r\n1,3,4\r\n",
        "t,a,b\r0,1,2\r1,3,4", "\"t\",\"a\",b\n\"0\",1,\"2\"\n1,3,4", "t , a , b\n0 , 1 , 2\n1, 3, 4\n\n\n",
        "# a log\n# t,a,b\n0,1,2\n1,3,4\n", "t,a,b,\n0,1,2,\n1,3,4,\n", "a,t,b\n1,0,2\n3,1,4\n", "\nt;a;b\n0,0;1,0;2,0\n1,0;3,0;4,0\n"}) {
    const Result<JointTable> table = parse_joint_table(text);
    ASSERT_TRUE(table.ok()) << text << to_line(table.issue());
    EXPECT_EQ(names_of(*table), names_of(plain)) << text;
    EXPECT_EQ(table->times_s, plain.times_s) << text;
    EXPECT_EQ(table->values, plain.values) << text;
  }
  EXPECT_EQ(names_of(*parse_joint_table("t,\"a, \"\"b\"\"\"\n0,1\n")), std::vector<std::string>{"a, \"b\""});
}

TEST(JointTable, HasTimesInTheUnitThatTheirNameSays) {
  for (const auto& [name, seconds] : std::vector<std::pair<const char*, double>>{
           {"time", 1.0}, {"Time", 1.0}, {"timestamp", 1.0}, {"secs", 1.0}, {"time [s]", 1.0}, {"time_from_start", 1.0},
           {"__time", 1.0}, {"t_ms", 1e-3}, {"Time (ms)", 1e-3}, {"time_us", 1e-6}, {"timestamp_ns", 1e-9},
           {"%time", 1e-9}}) {
    const Result<JointTable> table = parse_joint_table(std::string(name) + ",a\n2,0\n3,0\n");
    ASSERT_TRUE(table.ok()) << name << to_line(table.issue());
    EXPECT_EQ(table->times_s, (std::vector<double>{2.0 * seconds, 3.0 * seconds})) << name;
  }
}

TEST(JointTable, HasARateInsteadOfTimes) {
  EXPECT_EQ(parse_joint_table("a,b\n1,2\n3,4\n", 10.0)->times_s, (std::vector<double>{0.0, 0.1}));
  EXPECT_EQ(parse_joint_table("t,a\n0,1\n", 10.0).issue().code, "table.has_times");
}

TEST(JointTable, KeepsTheUnitsOfItsNames) {
  const JointTable table = *parse_joint_table("time [s],elbow [deg],slide (mm),position[3]\n0,1,2,3\n");
  EXPECT_EQ(names_of(table), (std::vector<std::string>{"elbow", "slide", "position[3]"}));
  EXPECT_EQ(table.columns[0].unit, "deg");
  EXPECT_EQ(table.columns[1].unit, "mm");
  EXPECT_EQ(table.columns[2].unit, "");
}

// The table is like those that rostopic echo -p writes.
TEST(JointTable, OfRosHasTheNamesOfItsPositionsInCells) {
  const std::string head = "%time,field.header.stamp,field.header.frame_id,field.name0,field.name1,"
                           "field.position0,field.position1,field.velocity0\n";
  const std::string row = "1500000000000000000,1500000000000000000,,arm,grip,0.1,0.2,nan\n";
  const Result<JointTable> table = parse_joint_table(head + row + "1500000000500000000,1500000000500000000,,arm,grip,0.3,0.4,nan\n");
  ASSERT_TRUE(table.ok()) << to_line(table.issue());
  EXPECT_EQ(names_of(*table)[3], "field.name1");
  EXPECT_EQ(names_of(*table)[4], "arm");
  EXPECT_EQ(names_of(*table)[5], "grip");
  EXPECT_FALSE(table->columns[5].fault);
  EXPECT_EQ(table->value(1, 5), 0.4);
  EXPECT_EQ(table->times_s[0], 0.0);
  EXPECT_NEAR(table->times_s[1], 0.5, 1e-6);
  ASSERT_EQ(table->remarks.size(), 2U);
  EXPECT_EQ(table->remarks[0].code, "table.ros");
  EXPECT_EQ(table->remarks[1].text, "times are counted from the first row, which is at 1500000000 s");
  const Result<JointTable> swapped = parse_joint_table(head + row + "1500000000500000000,1500000000500000000,,grip,arm,0.3,0.4,nan\n");
  ASSERT_FALSE(swapped.ok());
  EXPECT_EQ(swapped.issue().code, "table.names_change");
  EXPECT_EQ(swapped.issue().pointer, "line 3");
}

TEST(JointTable, ThatIsBrokenIsRefusedWithItsLine) {
  struct BadTable {
    const char* text;
    const char* code;
    const char* pointer;
    const char* says;
  };
  for (const BadTable& row : {BadTable{"", "table.empty", "", "a line of names"},
                              {"\n \n", "table.empty", "", "a line of names"},
                              {"t,a\n", "table.no_rows", "line 1", "no line of numbers"},
                              {"0,1\n2,3\n", "table.no_names", "line 1", "no names"},
                              {"a,b\n2,3\n", "table.no_times", "line 1", "found \"a\", \"b\", expected time, t"},
                              {"t,a,a\n0,1,2\n", "table.duplicate_name", "line 1", "\"a\""},
                              {"t,a [deg],a [rad]\n0,1,2\n", "table.duplicate_name", "line 1", "\"a\""},
                              {"t,,a\n0,1,2\n", "table.bad_name", "line 1", "column 2"},
                              {"t,a\n0,1\n1\n", "table.ragged", "line 3", "found 1 cells, and there are 2 names in line 1"},
                              {"t,a\n0,1\n\n1,2,3\n", "table.ragged", "line 4", "found 3 cells"},
                              {"t,a\n0,1\n0,2\n", "table.bad_time", "line 3", "column \"t\": found \"0\", which is not later"},
                              {"t,a\n1,1\n0.5,2\n", "table.bad_time", "line 3", "not later"},
                              {"t,a\nx,1\n", "table.bad_time", "line 2", "column \"t\": found \"x\""},
                              {"t,a\nnan,1\n", "table.bad_time", "line 2", "found \"nan\""},
                              {"t,a\ninf,1\n", "table.bad_time", "line 2", "found \"inf\""},
                              {"t,a\n1500000000000000000,1\n", "table.bad_time", "line 2", "time_ns"},
                              {"t,a\n0,\"1\n", "table.bad_quote", "line 2", "quote"}}) {
    const Result<JointTable> table = parse_joint_table(row.text);
    ASSERT_FALSE(table.ok()) << row.text;
    EXPECT_EQ(table.issue().code, row.code) << row.text;
    EXPECT_EQ(table.issue().pointer, row.pointer) << row.text;
    EXPECT_NE(table.issue().text.find(row.says), std::string::npos) << row.text << table.issue().text;
  }
}

// A column without a joint may have any content, so its first fault is only stored, for readers that use it as a joint.
TEST(JointTable, KeepsTheFirstFaultOfAColumn) {
  for (const auto& [cell, code] : std::vector<std::pair<std::string, std::string>>{{"x", "table.bad_number"},
                                                                                 {"", "table.bad_number"},
                                                                                 {"1 2", "table.bad_number"},
                                                                                 {"1e999", "table.bad_number"},
                                                                                 {"nan", "table.not_finite"},
                                                                                 {"-inf", "table.not_finite"},
                                                                                 {"2e6", "table.out_of_range"}}) {
    const Result<JointTable> table = parse_joint_table("t,a,b\n0,1,2\n1," + cell + ",2\n2,y,2\n");
    ASSERT_TRUE(table.ok()) << cell;
    ASSERT_TRUE(table->columns[0].fault) << cell;
    EXPECT_EQ(table->columns[0].fault->code, code) << cell;
    EXPECT_EQ(table->columns[0].fault->pointer, "line 3") << cell;
    EXPECT_NE(table->columns[0].fault->text.find("column \"a\""), std::string::npos);
    EXPECT_FALSE(table->columns[1].fault);
  }
}

TEST(JointTable, HasLimits) {
  std::string names = "t", row = "0";
  for (std::size_t i = 0; i < kMaxTableColumns; ++i) names += ",a" + std::to_string(i), row += ",0";
  EXPECT_EQ(parse_joint_table(names + "\n" + row + "\n").issue().code, "table.too_large");
  EXPECT_EQ(parse_joint_table("t,a\n0," + std::string(5'000'000, ',') + "\n").issue().code, "table.ragged");
}

TEST(JointTable, IsToldByItsNamesAndNumbers) {
  EXPECT_EQ(format_of_bytes("time,a\n0,1\n"), FileFormat::joint_table);
  EXPECT_EQ(format_of_bytes("# t a\n0 1\n"), FileFormat::joint_table);
  for (const char* other : {"", "a,b\n0,1\n", "time,a\nx,y\n", "the time is short\nand life, too\n", "{\"time\": 0}"})
    EXPECT_EQ(format_of_bytes(other), FileFormat::none) << other;
  const TempFolder folder;
  spill(folder / "a.csv", "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(read_joint_table(folder / "a.csv").issue().code, "table.wrong_kind");
  EXPECT_EQ(read_joint_table(folder / "none.csv").issue().code, "table.unreadable");
  spill(folder / "b.csv", "t,a\n0,1\n1\n");
  EXPECT_NE(read_joint_table(folder / "b.csv").issue().text.find("b.csv"), std::string::npos);
}

}  // namespace
}  // namespace contort
