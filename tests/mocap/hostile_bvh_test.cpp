// BVH files that want something else than to be read.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "formats/mocap/bvh.h"
#include "formats/mocap/limits.h"
#include "tests/corpus/temp_folder.h"
#include "tests/mocap/bvh_text.h"

namespace contort {
namespace {

struct HostileBvhText {
  const char* name;
  std::string text;
  const char* code;
  const char* pointer;
};

const std::string kLast = "0 90 90 -1e-1 .5 +3 90 90 0\n";
std::string with(const std::string& what, const std::string& by) { return replaced(small_bvh(), what, by); }

std::string deep(int joints) {
  std::string text = "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\n";
  for (int i = 1; i < joints; ++i) text += "JOINT j\n{\nOFFSET 0 0 0\n";
  return text + std::string(static_cast<std::size_t>(joints), '}') + "\nMOTION\nFrames: 0\nFrame Time: 1\n";
}

std::string wide(int joints) {
  std::string text = "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\n";
  for (int i = 1; i < joints; ++i) text += "JOINT j\n{\nOFFSET 0 0 0\n}\n";
  return text + "}\nMOTION\nFrames: 0\nFrame Time: 1\n";
}

const std::vector<HostileBvhText>& hostile_texts() {
  static const std::vector<HostileBvhText> all = {
      {"nothing", "", "bvh.truncated", "line 1"},
      {"something else", "glTF\x02", "bvh.bad_syntax", "line 1"},
      {"no root", "HIERARCHY\nMOTION\n", "bvh.bad_syntax", "line 2"},
      {"an unknown statement", with("OFFSET 0 0 0", "SCALE 1 1 1"), "bvh.bad_syntax", "line 8"},
      {"a joint without offset", with("    OFFSET 0 0 0\n", ""), "bvh.bad_syntax", "line 13"},
      {"two offsets", with("OFFSET 0 0 0", "OFFSET 0 0 0 OFFSET 0 0 0"), "bvh.bad_syntax", "line 8"},
      {"an end site with channels", with("1.25e1 0.0\n", "1.25e1 0.0\nCHANNELS 0\n"), "bvh.bad_syntax", "line 13"},
      {"an offset of two numbers", with("0.0 1.25e1 0.0", "0.0 1.25e1"), "bvh.bad_number", "line 13"},
      {"an offset that is none", with("0.0 1.25e1 0.0", "0.0 nan 0.0"), "bvh.out_of_range", "line 12"},
      {"an infinite offset", with("1.25e1", "1e999"), "bvh.out_of_range", "line 12"},
      {"a number with a comma", with("1.25e1", "1,25"), "bvh.bad_number", "line 12"},
      {"a hexadecimal number", with("1.25e1", "0x10"), "bvh.bad_number", "line 12"},
      {"an unknown channel", with("3 Xrotation", "3 Xscale"), "bvh.bad_channel", "line 9"},
      {"a channel twice", with("3 Xrotation", "3 Yrotation"), "bvh.bad_channel", "line 9"},
      {"channels twice", with("    End Site", "CHANNELS 0\nEnd Site"), "bvh.bad_channel", "line 10"},
      {"too many channels", with("CHANNELS 3", "CHANNELS 7"), "bvh.too_large", "line 9"},
      {"a negative number of channels", with("CHANNELS 3", "CHANNELS -3"), "bvh.bad_number", "line 9"},
      {"more channels than are named", with("CHANNELS 3", "CHANNELS 4"), "bvh.bad_channel", "line 10"},
      {"fewer channels than are named", with("CHANNELS 3", "CHANNELS 2"), "bvh.bad_syntax", "line 9"},
      {"a name of 2 kB", with("Hips", std::string(2048, 'x')), "bvh.too_large", "line 2"},
      {"joints too deep", deep(kMaxMocapDepth + 1), "bvh.too_deep", ""},
      {"too many joints", wide(kMaxMocapNodes + 1), "bvh.too_large", ""},
      {"the end inside of the hierarchy", small_bvh().substr(0, small_bvh().find("JOINT")), "bvh.truncated", ""},
      {"a negative number of frames", with("Frames: 2", "Frames: -2"), "bvh.bad_number", "line 17"},
      {"half a frame", with("Frames: 2", "Frames: 1.5"), "bvh.bad_number", "line 17"},
      {"frames that overflow", with("Frames: 2", "Frames: 99999999999999999999"), "bvh.bad_number", "line 17"},
      {"too many frames", with("Frames: 2", "Frames: 2000000000"), "bvh.too_large", "line 17"},
      {"too many numbers", with("Frames: 2", "Frames: 50000000"), "bvh.too_large", "line 17"},
      {"frames without numbers", small_bvh().substr(0, small_bvh().find("90 0 0")), "bvh.too_few_values", ""},
      {"no time between frames", with("0.25", "0"), "bvh.bad_frame_time", "line 18"},
      {"negative time", with("0.25", "-0.25"), "bvh.bad_frame_time", "line 18"},
      {"time that is no number", with("0.25", "nan"), "bvh.out_of_range", "line 18"},
      {"infinite time", with("0.25", "inf"), "bvh.out_of_range", "line 18"},
      {"a number too few", with("30 0 0 0\n", "30 0 0\n"), "bvh.too_few_values", "line 19"},
      {"a number too many", with("90 90 0\n", "90 90 0 1\n"), "bvh.too_many_values", "line 20"},
      {"an angle that is none", with(kLast, "nan 90 90 0 0 0 0 0 0\n"), "bvh.out_of_range", "line 20"},
      {"an endless turn", with(kLast, "1e30 90 90 0 0 0 0 0 0\n"), "bvh.out_of_range", "line 20"},
      {"a place beyond numbers", with(kLast, "0 90 90 1e200 0 0 0 0 0\n"), "bvh.out_of_range", "line 20"},
      {"a word among the numbers", with(kLast, "0 90 x 0 0 0 0 0 0\n"), "bvh.bad_number", "line 20"},
      {"a zero byte among the numbers", with(kLast, std::string("0 90 \0", 6) + "0 0 0 0 0 0\n"), "bvh.bad_number",
       "line 20"},
      {"text after the motion", small_bvh() + "HIERARCHY\n", "bvh.bad_number", "line 21"},
  };
  return all;
}

TEST(HostileBvh, IsRefusedByNameWithALine) {
  for (const HostileBvhText& hostile : hostile_texts()) {
    const auto result = parse_bvh(hostile.text, "");
    ASSERT_FALSE(result.ok()) << hostile.name;
    EXPECT_EQ(result.issue().code, hostile.code) << hostile.name << ": " << to_line(result.issue());
    if (*hostile.pointer != 0) {
      EXPECT_EQ(result.issue().pointer, hostile.pointer) << hostile.name << ": " << to_line(result.issue());
    }
    EXPECT_LT(result.issue().text.size(), 250U) << hostile.name;
    EXPECT_EQ(result.issue().text.find_first_of("\n\r\0"), std::string::npos) << hostile.name;
  }
}

TEST(HostileBvh, AsDeepAndAsWideAsAllowedIsRead) {
  const auto chain = parse_bvh(deep(kMaxMocapDepth), "");
  ASSERT_TRUE(chain.ok()) << to_line(chain.issue());
  EXPECT_EQ(chain->nodes.back().parent, kMaxMocapDepth - 2);
  const auto fan = parse_bvh(wide(kMaxMocapNodes), "");
  ASSERT_TRUE(fan.ok()) << to_line(fan.issue());
  EXPECT_EQ(fan->nodes.back().parent, 0);
}

TEST(HostileBvh, FoldersDevicesAndMissingFilesAreRefused) {
  const TempFolder folder;
  for (const std::string& path : {folder.path(), folder / "nothing.bvh", std::string("/dev/zero")}) {
    const auto result = read_bvh(path);
    ASSERT_FALSE(result.ok()) << path;
    EXPECT_EQ(result.issue().code, "bvh.unreadable") << path;
  }
}

// If at least one frame is complete, the text is read, and a remark reports that it is cut. At most the last number's
// digits and the last line end can be missing without a remark.
TEST(HostileBvh, ATextThatEndsEarlyIsRefusedOrRemarkedWhereverItEnds) {
  const std::string whole = replaced(small_bvh(), "0.25", "0.1");
  const std::size_t one_frame = whole.find("0 90 90 -1e-1") - 1;  // bytes up to the end of the first frame
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    const auto result = parse_bvh(whole.substr(0, size), "");
    ASSERT_EQ(result.ok(), size >= one_frame) << size;
    if (result.ok()) {
      EXPECT_NE(std::ranges::find(result->remarks, "bvh.frame_count", &Remark::code), result->remarks.end()) << size;
      continue;
    }
    EXPECT_TRUE(result.issue().code.starts_with("bvh.")) << size;
  }
}

// After any change, the result is an asset or an issue. Run under ASan and UBSan in the dev preset.
RC_GTEST_PROP(HostileBvhProperty, ChangedBytesNeverCrash, ()) {
  std::string text = small_bvh();
  const auto changes = *rc::gen::container<std::vector<std::pair<std::uint16_t, char>>>(
      rc::gen::arbitrary<std::pair<std::uint16_t, char>>());
  for (const auto& [place, value] : changes) text[place % text.size()] = value;
  const auto result = parse_bvh(text, "");
  if (!result.ok()) RC_ASSERT(result.issue().code.starts_with("bvh."));
}

RC_GTEST_PROP(HostileBvhProperty, ChangedNumbersNeverCrash, ()) {
  std::string text = small_bvh();
  std::vector<std::size_t> digits;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] >= '0' && text[i] <= '9') digits.push_back(i);
  const auto changes = *rc::gen::container<std::vector<std::pair<std::uint16_t, char>>>(
      rc::gen::pair(rc::gen::arbitrary<std::uint16_t>(), rc::gen::element('0', '1', '7', '9', '-', '.', 'e')));
  for (const auto& [place, digit] : changes) text[digits[place % digits.size()]] = digit;
  const auto result = parse_bvh(text, "");
  if (!result.ok()) RC_ASSERT(result.issue().code.starts_with("bvh."));
}

}  // namespace
}  // namespace contort
