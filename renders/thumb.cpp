#include "renders/thumb.h"

#include <algorithm>
#include <span>

#include "model/core/base64.h"
#include "renders/frames.h"
#include "renders/html.h"
#include "renders/report_cards.h"

namespace contort {

int worst_tile(const ReportRow& row) {
  if (row.strip.empty() || row.frame_count <= 0) return -1;
  const std::vector<int> frames = choose_frames(row.first_frame, row.worst_frame, row.last_frame, row.frame_count);
  const auto worst = std::ranges::find(frames, row.worst_frame);
  return worst == frames.end() ? -1 : static_cast<int>(worst - frames.begin());
}

std::string tile_class(const ReportRow& row) {
  const int tile = worst_tile(row);
  return tile < 0 ? "" : " tile-" + std::to_string(tile);
}

std::string picture_url(const std::string& path, const PageFiles& inside) {
  const auto file = inside.find(path);
  if (file == inside.end()) return html_url(path);
  return "data:image/png;base64," + to_base64(std::as_bytes(std::span(file->second)));
}

std::string thumb_html(const ReportRow& row, const PageFiles& inside) {
  const std::string tile = tile_class(row), url = html_url(row.strip);
  if (tile.empty() || url.empty() || !can_be_opened(row, inside)) return "";
  const std::string about = "Worst frame: " + row.check + ", " + row.subject;
  const std::string image = inside.empty() ? " src='" + url + "'" : attribute("data-picture-of", row.key);
  return "<a class='thumb" + tile + "'" + attribute("href", "#case=" + row.key) + "><img" + image +
         " loading='lazy' width='320' height='216'" + attribute("alt", about) + "></a>";
}

}  // namespace contort
