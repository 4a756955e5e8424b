#include "model/spec/spec.h"

#include "model/core/hash.h"
#include "model/spec/spec_fields.h"

namespace contort {

template struct json_fields::Codec<Spec>;

Result<Spec> parse_spec(std::string_view json) { return json_fields::read_document<Spec>(json, "spec"); }
std::string print_spec(const Spec& spec) { return json_fields::write_canonical(spec); }
std::string pretty_spec(const Spec& spec) { return json_fields::write_pretty(spec); }
std::string spec_id(const Spec& spec) { return content_id(print_spec(spec)); }
std::string spec_schema() { return json_fields::write_schema<Spec>("Contort action specification"); }

}  // namespace contort
