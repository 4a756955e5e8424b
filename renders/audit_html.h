// The page of an audit: how many motions of each action are clean, and a picture of the worst one.
#pragma once

#include <string>
#include <vector>

namespace contort {

struct AuditPageRow {
  std::string character;
  std::string part;    // "arm_left, rifle at hand_left/grip"
  std::string action;  // "aim muzzle"
  int draws = 0;       // > 0
  int clean = 0;       // motions without a finding
  int unmet = 0;       // motions with a request that was not met
  int still = 0;       // motions in which nothing moved
  std::string details;  // "self_collision 2; unmet: joint_speed 5"
  // Path of the worst motion's spec, relative to the page; "" if all motions are clean and meet their requests.
  std::string spec;
  std::string picture;  // path of its picture; the same
};

struct AuditPage {
  std::string command;  // command that makes the page again
  std::string tool;     // version of Contort
  std::vector<AuditPageRow> rows;
};

// Returns a page without scripts, in one file. Rows of a character are together, the worst first.
std::string audit_html(const AuditPage& page);

}  // namespace contort
