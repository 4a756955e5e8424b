#include "model/motion/intent.h"

namespace contort {

std::string_view layer_name(Layer layer) {
  switch (layer) {
    case Layer::overwrite: return "overwrite";
    case Layer::ik: return "ik";
    case Layer::additive: return "additive";
  }
  return "";
}

std::string_view shortfall_name(Shortfall shortfall) {
  switch (shortfall) {
    case Shortfall::out_of_reach: return "out_of_reach";
    case Shortfall::joint_range: return "joint_range";
    case Shortfall::joint_speed: return "joint_speed";
    case Shortfall::clearance: return "clearance";
    case Shortfall::rule_failed: return "rule_failed";
  }
  return "";
}

}  // namespace contort
