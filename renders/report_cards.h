// Makes the cards of the report's list, one for each family of failures, as markup. The page has as many as fit. The
// rows of the others (renders/report_rest.h) are made here too.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renders/report.h"

namespace contort {

// A card: the rows of one family, in the order of the model.
struct FamilyCard {
  std::vector<const ReportRow*> rows;
  bool gating() const;
};

// Returns the cards, gating ones first, otherwise in the order of the model.
std::vector<FamilyCard> cards_of(const ReportModel& model);

// The limits of a page. Most of a page's bytes would be in rows that are never read. After the first 80 buckets, rows
// show no picture until they are opened, and the viewer shows their specs.
struct Room {
  std::size_t buckets = 80;      // number of buckets that may still be shown with all details
  std::size_t spec_bytes = 0;    // bytes of specs that may still be written
  std::size_t bytes = 0;         // bytes of markup that may still be written; 0: the remaining rows go into other files
  void take(std::size_t written) { bytes -= written < bytes ? written : bytes; }
};

// The rows of a card that are not on the page.
struct LateCard {
  int number = 0;  // number of the card
  const FamilyCard* card = nullptr;
  std::vector<const ReportRow*> rows;
  bool begun = false;  // the page has the head of this card, to which these rows belong
};

// Returns the card with as many of its rows as fit, at least the first; the others go into `late`.
std::string card_html(const FamilyCard& card, LateCard& late, Room& room, const PageFiles& inside);

// Returns the words by which filters find a card, separated by spaces, each once.
std::string states_of(const FamilyCard& card);
std::string phases_of(const FamilyCard& card);
std::string parts_of(const ReportRow& row);  // "arm_left torso" for "human: arm_left/forearm ~ torso/chest"
// Returns each state once, and true if it gates, for the filter's buttons.
std::vector<std::pair<std::string, bool>> chips_of(const FamilyCard& card);
std::string count_of(const FamilyCard& card);     // "1 280 cases, 2 failures"
std::string short_text(const ReportRow& row);     // "worst … at …, just after an interrupt; needs walk"
bool can_be_opened(const ReportRow& row, const PageFiles& inside);

// Returns a command with a button that copies it; "" if there is none.
std::string command_html(const std::string& command);

// Returns one attribute with a leading space.
std::string attribute(std::string_view name, std::string_view value);

}  // namespace contort
