#include "model/spec/action_param.h"

namespace contort {

double steps_per_unit(std::string_view param_name) {
  if (param_name.ends_with("_m_s")) return 10.0;
  return param_name.ends_with("_m") || param_name == "share" ? 100.0 : 1.0;
}

double steps_of(const ParamDef& def) { return def.steps > 0.0 ? def.steps : steps_per_unit(def.name); }

}  // namespace contort
