// Checks the rules that the fields of a part or an object must satisfy together, beyond the limits of each field.
#pragma once

#include "model/character/desc.h"
#include "model/core/result.h"

namespace contort {

// Checks a part. Codes part.duplicate_name, .unknown_joint, .unknown_socket, .bad_axis, .bad_range, .other_type,
// .bad_shape, .bad_reach, .bad_facing, with pointers into the part.
Result<Done> check_part(const PartDesc& part);

// Checks an object, which has no joints. Codes object.duplicate_name, .unknown_joint, .bad_shape.
Result<Done> check_object(const ObjectDesc& object);

}  // namespace contort
