// The worst frame of a failure, cut out of its film strip by the page's style sheet, so that no picture is drawn or
// stored twice.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Returns the place of the worst frame among the tiles of the row's film strip, counted from 0 in reading order; -1 if
// the row has no strip, or its number of frames is not known.
int worst_tile(const ReportRow& row);

// Returns the style classes that cut the worst frame out of the strip, such as " tile-5"; "" if it is not known.
std::string tile_class(const ReportRow& row);

// Returns the address of a picture of the report: beside the page, or within it.
std::string picture_url(const std::string& path, const PageFiles& inside);

// Returns a link to the case with the picture of its worst frame; "" if there is no picture. In a page that contains
// everything, page.js takes the picture from the failure's card.
std::string thumb_html(const ReportRow& row, const PageFiles& inside);

}  // namespace contort
