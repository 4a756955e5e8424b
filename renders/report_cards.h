// Cards of the report's list: what is said about a family of failures, as markup. The page holds as many as fit; what
// is told of the rest (renders/report_rest.h) comes from here too.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renders/report.h"

namespace contort {

// Rows of one family, in the order of the model.
struct FamilyCard {
  std::vector<const ReportRow*> rows;
  bool gating() const;
};

// Those that gate come first; else in the order of the model.
std::vector<FamilyCard> cards_of(const ReportModel& model);

// The limits of a page. Most of a page's bytes would be in rows that nobody reads: after the first 80 buckets they
// have no picture before they are opened, and specs are left to the viewer.
struct Room {
  std::size_t buckets = 80;      // that may still be shown with everything
  std::size_t spec_bytes = 0;    // that they may still write out
  std::size_t bytes = 0;         // of markup; 0: what is left goes elsewhere
  void take(std::size_t written) { bytes -= written < bytes ? written : bytes; }
};

// The rows of a card that are not on the page.
struct LateCard {
  int number = 0;  // of the card
  const FamilyCard* card = nullptr;
  std::vector<const ReportRow*> rows;
  bool begun = false;  // its head is on the page, and these rows belong to it
};

// The card with as many of its rows as fit; the others go into `late`. At least the first is there.
std::string card_html(const FamilyCard& card, LateCard& late, Room& room, const PageFiles& inside);

// The words that filters ask a card for, with spaces between, each once.
std::string states_of(const FamilyCard& card);
std::string phases_of(const FamilyCard& card);
std::string parts_of(const ReportRow& row);  // "arm_left torso" of "human: arm_left/forearm ~ torso/chest"
// Each state once, with whether it gates: what the chips say.
std::vector<std::pair<std::string, bool>> chips_of(const FamilyCard& card);
std::string count_of(const FamilyCard& card);     // "1 280 cases, 2 buckets"
std::string short_text(const ReportRow& row);     // "worst … at …, just after an interrupt; needs walk"
bool can_be_opened(const ReportRow& row, const PageFiles& inside);

// One attribute with its leading space.
std::string attribute(std::string_view name, std::string_view value);

}  // namespace contort
