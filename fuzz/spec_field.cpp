#include "fuzz/spec_field.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "model/spec/spec_fields.h"

namespace contort {

namespace {

using json_fields::Rule;

// A field of one spec in memory. The closures hold references into it.
struct Leaf {
  SpecField place;
  bool is_default = false;
  std::function<void()> reset;  // empty for components of a parameter, whose default depends on the action
  std::function<void(double)> set_number;
  std::function<void(const std::string&)> set_word;
};
using Leaves = std::vector<Leaf>;

// Returns true for frames, masses and impulses, which have no natural upper end.
bool is_open_ended(const std::string& name) {
  return name.ends_with("frames") || name.ends_with("frame") || name.ends_with("_kg") || name == "impulse_N_s";
}

double lattice_of(const std::string& name) {
  if (name == "speed") return 20.0;
  return name.ends_with("_kg") || name == "impulse_N_s" ? 2.0 : steps_per_unit(name);
}

SpecField number_place(const std::string& pointer, const std::string& name, double value, double preset, double low,
                       double high) {
  SpecField place{pointer, true, value, preset, low, high, lattice_of(name), {}};
  if (!is_open_ended(name)) return place;
  const double reach = 2.0 * std::max({value, -value, preset});
  place.low = std::max(low, -reach), place.high = std::min(high, reach);
  return place;
}

template <class Number>
void add_number(Leaves& out, const std::string& pointer, const std::string& name, Number& at, Number preset,
                const Rule& rule) {
  out.push_back({number_place(pointer, name, static_cast<double>(at), static_cast<double>(preset), rule.low, rule.high),
                 at == preset,
                 [&at, preset] { at = preset; },
                 [&at](double value) { at = static_cast<Number>(value); },
                 {}});
}

// Adds any other field that has a default: a flag, a name, a kind of ground.
template <class T>
void add_other(Leaves& out, const std::string& pointer, T& at, const T& preset) {
  SpecField place;
  place.pointer = pointer;
  out.push_back({place, at == preset, [&at, preset] { at = preset; }, {}, {}});
}

// A character, or none, and the actions that its parts offer.
struct Actor {
  const Character* character = nullptr;
  const Offers* offers = nullptr;
};

std::span<const ParamDef> defs_of(const ActionUse& use, const Actor& actor) {
  if (actor.character == nullptr) return {};
  const OfferedAction* action = find_offer(*actor.offers, actor.character->find_part(use.slot), use.action);
  return action != nullptr ? std::span<const ParamDef>(action->params) : std::span<const ParamDef>();
}

void add_param(Leaves& out, const std::string& pointer, ActionUse& use, const std::string& name,
               const ParamDef& declared) {
  ParamValue& value = use.params.at(name);
  const Rule limits{.low = declared.low, .high = declared.high};
  if (double* number = std::get_if<double>(&value)) {
    const double* preset = std::get_if<double>(&declared.preset);
    add_number(out, pointer, name, *number, preset != nullptr ? *preset : 0.0, limits);
    out.back().is_default = false;  // a parameter that is given can be left out
    if (declared.steps > 0.0) out.back().place.steps_per_unit = declared.steps;
    out.back().reset = [&use, name] { use.params.erase(name); };
  } else if (Vec3* vector = std::get_if<Vec3>(&value)) {
    const Vec3* preset = std::get_if<Vec3>(&declared.preset);
    for (int i = 0; i < 3; ++i) {
      add_number(out, pointer + "/" + std::to_string(i), name, (*vector)[i], preset != nullptr ? (*preset)[i] : 0.0,
                 limits);
      out.back().reset = {};
      if (declared.steps > 0.0) out.back().place.steps_per_unit = declared.steps;
      if (!declared.box.empty())
        out.back().place.low = declared.box[0][i], out.back().place.high = declared.box[1][i];
    }
  } else {
    SpecField place;
    place.pointer = pointer;
    place.words = declared.choices;
    out.push_back({place,
                   false,
                   [&use, name] { use.params.erase(name); },
                   {},
                   [&value](const std::string& word) { value = word; }});
  }
}

void add_params(Leaves& out, const std::string& at, ActionUse& use, const Actor& actor) {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  const std::span<const ParamDef> defs = defs_of(use, actor);
  for (const auto& [name, value] : use.params) {
    const auto def = std::ranges::find(defs, name, &ParamDef::name);
    ParamDef unknown;
    unknown.low = -kNoLimit, unknown.high = kNoLimit;
    add_param(out, at + "/params/" + name, use, name, def != defs.end() ? *def : unknown);
  }
}

// A visitor of field lists, like the three of json_fields.h. It collects the fields of one struct and of all structs
// inside it.
template <class S>
class PlaceWalker {
 public:
  PlaceWalker(S& value, std::string at, const Actor& actor, Leaves& out)
      : value_(value), at_(std::move(at)), actor_(actor), out_(out) {
    fields(*this, static_cast<const S*>(nullptr));
    if constexpr (std::is_same_v<S, ActionUse>) add_params(out_, at_, value_, actor_);
  }

  void constant(std::string_view, std::string_view) {}

  template <class T>
  void field(std::string_view name, T S::*member, const Rule& rule, std::string_view) {
    static const S defaults{};
    visit(at_ + "/" + std::string(name), std::string(name), value_.*member, defaults.*member, rule);
  }

 private:
  template <class T>
  void visit(const std::string& at, const std::string& name, T& value, const T& preset, const Rule& rule) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
      add_number(out_, at, name, value, preset, rule);
    } else if constexpr (std::is_same_v<T, Vec3>) {
      for (int i = 0; i < 3; ++i) add_number(out_, at + "/" + std::to_string(i), name, value[i], preset[i], rule);
    } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, bool>) {
      if (!rule.required) add_other(out_, at, value, preset);
    } else if constexpr (std::is_enum_v<T>) {
      if (!rule.required) add_enum(at, value, preset);
    } else {
      descend(at, value, preset);
    }
  }

  // Modes are ordered, so a mode can be moved towards its default in steps; but it has no range of other values. A spec
  // with impacts keeps its mode, because the mode tracking has no strength or balance to answer a blow.
  template <class E>
  void add_enum(const std::string& at, E& value, E preset) {
    if constexpr (std::is_same_v<S, DynamicsDesc>)
      if (!value_.impacts.empty()) return;
    SpecField place{at, true, static_cast<double>(value), static_cast<double>(preset), 0.0, 0.0, 1.0, {}};
    place.low = place.high = place.value;
    out_.push_back({place,
                    value == preset,
                    [&value, preset] { value = preset; },
                    [&value](double number) { value = static_cast<E>(static_cast<int>(number)); },
                    {}});
  }

  // Inner fields come before the whole field, because resetting the whole removes the inner fields.
  template <class T>
  void descend(const std::string& at, T& value, const T&) {
    PlaceWalker<T>(value, at, actor_, out_);
  }
  template <class T>
  void descend(const std::string& at, std::vector<T>& list, const std::vector<T>&) {
    if constexpr (std::is_class_v<T>)
      for (std::size_t i = 0; i < list.size(); ++i)
        PlaceWalker<T>(list[i], at + "/" + std::to_string(i), actor_, out_);
  }
  void descend(const std::string& at, Ground& ground, const Ground& preset) {
    std::visit([&]<class G>(G& kind) { PlaceWalker<G>(kind, at, actor_, out_); }, ground);
    add_other(out_, at, ground, preset);
  }
  void descend(const std::string& at, ConditionDesc& condition, const ConditionDesc& preset) {
    PlaceWalker<ConditionDesc>(condition, at, actor_, out_);
    add_other(out_, at, condition, preset);
  }
  void descend(const std::string&, ColliderShape&, const ColliderShape&) {}  // obstacles are only removed as a whole
  void descend(const std::string&, CharacterChoice&, const CharacterChoice&) {}  // as are swaps and attachments
  template <class T>
  void descend(const std::string&, std::map<std::string, T>&, const std::map<std::string, T>&) {}

  S& value_;
  std::string at_;
  const Actor& actor_;
  Leaves& out_;
};

Leaves leaves_of(Spec& spec, const Actor& actor) {
  Leaves leaves;
  PlaceWalker<Spec>(spec, "", actor, leaves);
  return leaves;
}

template <class Change>
void change(Spec& spec, const SpecField& place, const Change& how) {
  for (const Leaf& leaf : leaves_of(spec, {}))
    if (leaf.place.pointer == place.pointer) return how(leaf);
}

}  // namespace

std::vector<SpecField> spec_fields_of(const Spec& spec, Generator& generator, const Character* character) {
  Spec copy = spec;
  const Actor actor{character, character != nullptr ? &generator.offers(*character) : nullptr};
  std::vector<SpecField> places;
  for (Leaf& leaf : leaves_of(copy, actor))
    if (!leaf.is_default) places.push_back(std::move(leaf.place));
  return places;
}

void reset_spec_fields(Spec& spec, std::span<const SpecField> places) {
  std::map<std::string_view, double> presets;
  for (const SpecField& place : places) presets[place.pointer] = place.preset;
  for (const Leaf& leaf : leaves_of(spec, {})) {
    const auto wanted = presets.find(leaf.place.pointer);
    if (wanted == presets.end()) continue;
    if (leaf.reset)
      leaf.reset();
    else
      leaf.set_number(wanted->second);
  }
}

void set_spec_field(Spec& spec, const SpecField& place, double value) {
  change(spec, place, [value](const Leaf& leaf) { leaf.set_number(value); });
}

void set_spec_field(Spec& spec, const SpecField& place, const std::string& word) {
  change(spec, place, [&word](const Leaf& leaf) { leaf.set_word(word); });
}

}  // namespace contort
