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

}  // namespace contort
