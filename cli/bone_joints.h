// The bones of an imported model as the joints of a guest.
#pragma once

#include "guest/manifest.h"
#include "import/import.h"

namespace contort::cli {

// Joints have the names of the model's nodes and their frames at rest, in the file's axes and unit. Ranges, slots and
// colliders are those of the import. A bone that turns by two hinges, such as an ankle, becomes a ball without limits.
// Codes of build_character.
Result<GuestCharacter> joints_of_bones(const Asset& asset, const Imported& imported);

}  // namespace contort::cli
