// RapidCheck draws a RawSpec, which contains only bounded whole numbers; compose() reads them as choices among the
// generator's offers. Three properties of RapidCheck shape this file (docs/internals/fuzzing.md). gen::exec and `*gen`
// are not thread safe, so only pure combinators are used. List lengths of gen::container follow the size parameter and
// multiply when nested, so lists have their own generator. There is no bounded real, so reals are whole numbers on a
// lattice.
#include "fuzz/draw.h"

#include <rapidcheck.h>

#include <array>

#include "fuzz/compose.h"

namespace contort {

namespace {

constexpr int kSize = 100;                                    // RapidCheck's size; nothing here depends on it
constexpr std::uint64_t kDrawStream = 0x636f6e746f727436ULL;  // changes when the meaning of (seed, index) changes

// Uniform on 0 … kLattice. It consumes one draw of the splittable generator.
rc::Gen<int> lattice() {
  return [](const rc::Random& random, int) {
    rc::Random own(random);
    return rc::shrinkable::just(static_cast<int>(own.next() % (kLattice + 1)));
  };
}

// A list of 1 to `most` elements; its length is drawn independently of the elements.
template <class T>
rc::Gen<std::vector<T>> list_up_to(int most, const rc::Gen<T>& element) {
  return [=](const rc::Random& random, int size) {
    rc::Random own(random);
    rc::Random for_length = own.split();
    const auto length = static_cast<std::size_t>(1 + for_length.next() % static_cast<std::uint64_t>(most));
    std::vector<T> list;
    for (std::size_t i = 0; i < length; ++i) list.push_back(element(own.split(), size).value());
    return rc::shrinkable::just(std::move(list));
  };
}

rc::Gen<RawAction> raw_action() {
  return rc::gen::build<RawAction>(
      rc::gen::set(&RawAction::slot, lattice()), rc::gen::set(&RawAction::action, lattice()),
      rc::gen::set(&RawAction::start, lattice()), rc::gen::set(&RawAction::duration, lattice()),
      rc::gen::set(&RawAction::speed, lattice()), rc::gen::set(&RawAction::blend_in, lattice()),
      rc::gen::set(&RawAction::blend_out, lattice()),
      rc::gen::set(&RawAction::values, rc::gen::container<std::array<int, kRawValues>>(lattice())));
}

rc::Gen<RawClip> raw_clip() {
  return rc::gen::build<RawClip>(rc::gen::set(&RawClip::start, lattice()), rc::gen::set(&RawClip::speed, lattice()),
                                 rc::gen::set(&RawClip::stretch, lattice()),
                                 rc::gen::set(&RawClip::actions, list_up_to(4, raw_action())));
}

rc::Gen<RawInterrupt> raw_interrupt() {
  return rc::gen::build<RawInterrupt>(
      rc::gen::set(&RawInterrupt::event, lattice()), rc::gen::set(&RawInterrupt::what, lattice()),
      rc::gen::set(&RawInterrupt::enter, lattice()), rc::gen::set(&RawInterrupt::after, lattice()),
      rc::gen::set(&RawInterrupt::resume, lattice()), rc::gen::set(&RawInterrupt::clips, list_up_to(2, raw_clip())));
}

rc::Gen<RawSpec> raw_spec() {
  return rc::gen::build<RawSpec>(
      rc::gen::set(&RawSpec::character, lattice()), rc::gen::set(&RawSpec::hold, lattice()),
      rc::gen::set(&RawSpec::interrupted, lattice()), rc::gen::set(&RawSpec::obstacle, lattice()),
      rc::gen::set(&RawSpec::ground, rc::gen::container<std::array<int, kRawGround>>(lattice())),
      rc::gen::set(&RawSpec::parts, rc::gen::container<std::array<int, kRawParts>>(lattice())),
      rc::gen::set(&RawSpec::objects, rc::gen::container<std::array<int, kRawObjects>>(lattice())),
      rc::gen::set(&RawSpec::dynamics, rc::gen::container<std::array<int, kRawDynamics>>(lattice())),
      rc::gen::set(&RawSpec::sequences, list_up_to(2, list_up_to(3, raw_clip()))),
      rc::gen::set(&RawSpec::interrupts, list_up_to(2, raw_interrupt())));
}

}  // namespace

RawSpec draw_raw(std::int64_t seed, std::int64_t index, std::uint64_t stream) {
  static const rc::Gen<RawSpec> gen = raw_spec();
  const rc::Random random(
      rc::Random::Key{{static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(index), kDrawStream, stream}});
  return gen(random, kSize).value();
}

Spec draw_spec(const DrawConfig& config, Generator& generator, std::int64_t seed, std::int64_t index) {
  return compose(draw_raw(seed, index), config, generator);
}

}  // namespace contort
