#include "renders/raster/sheet.h"

#include <algorithm>
#include <string>
#include <vector>

#include "renders/wording.h"

namespace contort {
namespace {

constexpr int kHeader = 58;
constexpr int kCaption = 24;
constexpr int kLegendLine = 24;
constexpr int kSheetGap = 2;
constexpr int kSheetPadding = 12;
constexpr int kTitleSize = 18;
constexpr int kTextSize = 14;
constexpr int kCaptionSize = 13;

constexpr Rgb8 kFrame{24, 29, 36};
constexpr Rgb8 kBright{240, 243, 246};
constexpr Rgb8 kDim{168, 177, 187};
constexpr Rgb8 kAlarm{255, 138, 128};
constexpr Rgb8 kCaptionCalm{57, 66, 78};
constexpr Rgb8 kCaptionInside{112, 34, 34};
constexpr Rgb8 kCaptionWorst{190, 30, 30};

std::string range_text(int first, int last) {
  return first == last ? "frame " + std::to_string(first)
                       : "frames " + std::to_string(first) + "\xE2\x80\x93" + std::to_string(last);
}

// In a narrow strip the end of the title is cut, so that the subject comes first.
std::string title_of(const StripInput& input, bool is_narrow) {
  if (!input.title.empty() || !input.finding) return input.title.empty() ? input.character.name() : input.title;
  const Finding& f = *input.finding;
  return is_narrow ? f.subject + "  " + f.check : f.check + "  " + f.subject;
}

std::string summary_of(const StripInput& input) {
  const Motion& motion = input.motion;
  const Finding* f = input.finding;
  if (!f) return range_text(0, motion.frame_count - 1) + ", " + time_text(motion.frame_count, motion.rate_hz);
  const std::string value = input.measured.empty() ? margin_text(f->worst_margin, f->unit) : input.measured;
  return value + "; worst at frame " + std::to_string(f->worst_frame) + ", " +
         time_text(f->worst_frame, motion.rate_hz) + "; violated in " + range_text(f->first_frame, f->last_frame) +
         " of " + std::to_string(motion.frame_count);
}

// Breaks a legend between its entries.
std::vector<std::string> lines_of(std::string_view legend, std::size_t most) {
  std::vector<std::string> lines;
  while (!legend.empty()) {
    const std::size_t end = std::min(legend.find("; "), legend.size());
    const std::string entry(legend.substr(0, end));
    legend.remove_prefix(std::min(end + 2, legend.size()));
    if (!lines.empty() && lines.back().size() + 2 + entry.size() <= most)
      lines.back() += "; " + entry;
    else
      lines.push_back(entry);
  }
  return lines;
}

struct Caption {
  std::string_view mark;
  Rgb8 color;
};

Caption caption_of(const Finding* finding, int frame) {
  if (!finding || frame < finding->first_frame || frame > finding->last_frame) return {"", kCaptionCalm};
  if (frame == finding->worst_frame) return {"worst", kCaptionWorst};
  if (frame == finding->first_frame) return {"first", kCaptionInside};
  return {frame == finding->last_frame ? "last" : "", kCaptionInside};
}

}  // namespace

int Sheet::picture_height(const StripInput& input) { return input.tile_height - kCaption; }

double Sheet::picture_aspect(const StripInput& input) {
  return static_cast<double>(input.tile_width) / picture_height(input);
}

Sheet::Sheet(const StripInput& input, int tiles, const std::string& legend) : input_(input), face_{input.font} {
  const int columns = std::min(input.columns, tiles);
  const int rows = (tiles + columns - 1) / columns;
  const int below_tiles = kHeader + rows * (input.tile_height + kSheetGap);
  const int width = columns * (input.tile_width + kSheetGap) + kSheetGap, room = width - 2 * kSheetPadding;
  const std::vector<std::string> lines = lines_of(legend, static_cast<std::size_t>(face_.fits(room, kCaptionSize)));
  image_ = Image(width, below_tiles + static_cast<int>(lines.size()) * kLegendLine);
  fill(image_, 0, 0, image_.width, image_.height, kFrame);
  write_header(columns == 1);
  for (std::size_t i = 0; i < lines.size(); ++i)
    write(kSheetPadding, below_tiles + static_cast<int>(i) * kLegendLine + 16, room, lines[i], kCaptionSize, kDim);
}

Sheet::Corner Sheet::add_tile(const Image& picture, int frame, bool complete) {
  const int column = added_ % input_.columns, row = added_ / input_.columns;
  const int x = kSheetGap + column * (input_.tile_width + kSheetGap),
            y = kHeader + row * (input_.tile_height + kSheetGap);
  paste(image_, picture, x, y);
  write_caption(x, y + picture.height, frame, complete);
  ++added_;
  return {x, y};
}

void Sheet::write_header(bool is_narrow) {
  const int width = image_.width - 2 * kSheetPadding;
  write(kSheetPadding, 25, width, title_of(input_, is_narrow), kTitleSize, kBright);
  const std::string note = input_.note.empty() ? "" : "; " + input_.note;
  const bool alarms = input_.finding || !note.empty();
  write(kSheetPadding, 47, width, summary_of(input_) + note, kTextSize, alarms ? kAlarm : kDim);
}

void Sheet::write_caption(int x, int y, int frame, bool complete) {
  const Caption caption = caption_of(input_.finding, frame);
  fill(image_, x, y, input_.tile_width, kCaption, caption.color);
  const int baseline = y + 17;
  std::string text = "frame " + std::to_string(frame) + "  " + time_text(frame, input_.motion.rate_hz);
  if (!complete) text += "  NOT FINITE";
  const int mark_width = 8 * static_cast<int>(caption.mark.size());
  const int room = input_.tile_width - 2 * kSheetPadding;
  write(x + kSheetPadding, baseline, room - mark_width, text, kCaptionSize, kBright);
  write(x + input_.tile_width - kSheetPadding - mark_width, baseline, mark_width, caption.mark, kCaptionSize, kBright);
}

void Sheet::write(int x, int y, int width, std::string_view text, int size, Rgb8 color) {
  if (text_issue_) return;  // One warning is enough.
  const Result<Done> written =
      write_text(image_, x, y, drawable_text(text, face_.fits(width, size)), size, color, face_);
  if (!written) text_issue_ = written.issue();
}

}  // namespace contort
