// The folder of an audit's page: index.html, the worst motion of each row, and pictures of those.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"
#include "fuzz/audit.h"

namespace contort::cli {

// "rifle at hand_right/grip"; "" without an object.
std::string object_of(const AuditRow& row);

// A file name such as "human-arm_left-reach" or "human-arm_right-aim-muzzle-rifle-hand_right-grip", unique for each
// row.
std::string file_name_of(const AuditRow& row);

// "self_collision 2; unmet: joint_speed 5; refused: the angle is too large 3; crash: the program ended: exit 1".
std::string details_of(const AuditRow& row);

// Writes the specs of the worst motions, NAME.json. Code file.unwritable.
Result<Done> write_worst(const std::string& folder, const std::vector<AuditRow>& rows);

// Writes the page. `command` makes it again. Pictures that cannot be drawn are reported on standard error, and the page
// is complete without them; the exit code is then kInternal. Code file.unwritable.
Result<Done> write_audit_page(const std::string& folder, const std::string& command, const std::vector<AuditRow>& rows,
                              Context& context);

}  // namespace contort::cli
