#include "formats/mocap/bvh.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"
#include "tests/mocap/bvh_text.h"

namespace contort::hostile {

namespace {

// The stock one, and a recording called "small" for specs that play one.
const Library& library_with_recording() {
  static const Library library = [] {
    Library out = stock_library();
    out.recordings["small"] = std::make_shared<const Asset>(*parse_bvh(small_bvh(), "small"));
    return out;
  }();
  return library;
}

}  // namespace

bool try_spec(std::string_view bytes) {
  const Result<Spec> spec = parse_spec(bytes);
  if (!spec) return require_clean(spec.issue()), false;
  const Result<Spec> again = parse_spec(print_spec(*spec));
  require(again.ok() && *again == *spec, "what is printed reads back as the same spec");
  return play(*spec, library_with_recording());
}

}  // namespace contort::hostile
