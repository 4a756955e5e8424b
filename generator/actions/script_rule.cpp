// script: joints follow what a script of an action file computes in each frame.
#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/actions/action.h"
#include "model/core/index.h"

namespace contort {

std::vector<ParamDef> pose_params(const Character&, const Part&);  // a row of action_list.inc

namespace {

using Kind = ScriptPlan::Kind;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

void put_joint(const ScriptPlan& plan, const ScriptPlan::Value& value, const double* set, Posture& posture) {
  double* q = posture.coords.data() + value.source;
  if (value.kind == Kind::ball) {
    const Quat turn = from_rotation_vector(Vec3(set[0], set[1], set[2]) * kRadPerDeg);
    const Quat whole = plan.adds ? Quat(q[0], q[1], q[2], q[3]) * turn : turn;
    q[0] = whole.w, q[1] = whole.x, q[2] = whole.y, q[3] = whole.z;
    return;
  }
  const double number = value.kind == Kind::hinge ? set[0] * kRadPerDeg : set[0];
  q[0] = plan.adds ? q[0] + number : number;
}

void script_rule(const RuleInput& in, Posture& posture) {
  for (const ScriptPlan::Value& value : in.script->sets)
    put_joint(*in.script, value, in.params.data() + value.first, posture);
}

void start_joint(const ScriptPlan::Value& value, const Posture& posture, double* row) {
  const double* q = posture.coords.data() + value.source;
  if (value.kind != Kind::ball) {
    row[0] = value.kind == Kind::hinge ? q[0] / kRadPerDeg : q[0];
    return;
  }
  const Vec3 turn_deg = to_rotation_vector(Quat(q[0], q[1], q[2], q[3])) / kRadPerDeg;
  row[0] = turn_deg.x, row[1] = turn_deg.y, row[2] = turn_deg.z;
}

bool is_joint(const ScriptPlan::Value& value) { return value.kind != Kind::number && value.kind != Kind::vector; }

Kind kind_of(const Joint& joint) {
  if (joint.kind == JointKind::ball) return Kind::ball;
  return joint.kind == JointKind::hinge ? Kind::hinge : Kind::travel;
}

// The parameters of a built-in action, and those of the file, with their places in the row of parameters.
std::vector<ScriptPlan::Value> param_values(const ActionDesc& action, const Character& character, const Part& part) {
  const bool right = part.side == Side::right;
  std::vector<ScriptPlan::Value> values;
  int place = 0;
  for (const ParamDef& param : params_of({action.name, action.help, def_of(action), &action}, character, part)) {
    const bool is_vector = param.type == ParamType::vector;
    if (is_vector || param.type == ParamType::number)
      values.push_back({param.name, is_vector ? Kind::vector : Kind::number, place, place, param.low, param.high,
                        right ? param.mirrored : Mirrored::same});
    place += is_vector ? 3 : 1;
  }
  return values;
}

// The joints of a part, by the names of the parameters of `pose`.
std::vector<ScriptPlan::Value> joint_values(const Character& character, const Part& part) {
  const std::vector<ParamDef> defs = pose_params(character, part);
  std::vector<ScriptPlan::Value> values;
  for (int i = 0; i < part.joint_count; ++i) {
    const ParamDef& def = defs[at(i)];
    const Joint& joint = character.joints()[at(part.first_joint + i)];
    values.push_back({def.name, kind_of(joint), joint.coord, 0, def.low, def.high,
                      part.side == Side::right ? def.mirrored : Mirrored::same});
  }
  return values;
}

std::vector<ParamDef> no_own_params(const Character&, const Part&) { return {}; }
bool moves_joints(const Character&, const Part& part) { return part.joint_count > 0; }

ActionDef def_on(Layer layer) {
  return {"script",      layer,         Timing::course, Spread::own, Promise::none, Tells::nothing, "Computed by a script.",
          no_own_params, moves_joints, script_rule};
}

}  // namespace

std::string script_text(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line, text += '\n';
  return text;
}

const ActionDef& script_def(bool adds) {
  static const ActionDef replaces = def_on(Layer::ik), added = def_on(Layer::additive);
  return adds ? added : replaces;
}

const ActionDef& course_of(const ActionDef& def) {
  static const std::vector<ActionDef> courses = [] {
    std::vector<ActionDef> all(all_actions().begin(), all_actions().end());
    for (ActionDef& course : all) course.timing = Timing::course;
    return all;
  }();
  return *std::ranges::find(courses, def.name, &ActionDef::name);
}

bool takes_computed_params(const ActionDef& def, const Character& character, const Part& part) {
  if (def.spread == Spread::legs || def.layer == Layer::overwrite) return false;
  return std::ranges::none_of(def.params(character, part), [](const ParamDef& param) {
    return param.type == ParamType::own_point || param.type == ParamType::object_point;
  });
}

ScriptPlan plan_script(const ActionDesc& action, const Character& character, const Part& part) {
  ScriptPlan plan;
  plan.source = script_text(action.script);
  plan.adds = action.adds;
  std::vector<ScriptPlan::Value> settable = joint_values(character, part);
  plan.reads = param_values(action, character, part);
  if (!action.of.empty()) settable = plan.reads;
  for (const std::string& name : action.sets) {
    ScriptPlan::Value value = *std::ranges::find(settable, name, &ScriptPlan::Value::name);
    std::erase_if(plan.reads, [&](const ScriptPlan::Value& read) { return read.name == name; });
    value.first = plan.row_size, plan.row_size += value.size();
    plan.sets.push_back(std::move(value));
  }
  return plan;
}

void start_row(const ScriptPlan& plan, std::span<const double> params, const Posture& posture, std::span<double> row) {
  std::ranges::fill(row, 0.0);
  for (const ScriptPlan::Value& value : plan.sets) {
    double* to = row.data() + value.first;
    if (!is_joint(value)) std::copy_n(params.begin() + value.source, value.size(), to);
    if (is_joint(value) && !plan.adds) start_joint(value, posture, to);
  }
}

void put_params(const ScriptPlan& plan, std::span<const double> row, std::span<double> params) {
  for (const ScriptPlan::Value& value : plan.sets)
    std::copy_n(row.begin() + value.first, value.size(), params.begin() + value.source);
}

Result<Done> try_script(const ActionDesc& action, const Character& character, const Part& part) {
  const ScriptPlan plan = plan_script(action, character, part);
  const Result<std::vector<double>> params =
      bind_params({action.name, action.help, def_of(action), &action}, character, part, {});
  if (!params) return params.issue();
  const Environment level;
  Posture posture;
  posture.coords.assign(character.rest_coords().begin(), character.rest_coords().end());
  std::vector<double> row(at(plan.row_size), kNothing);
  ScriptHost host;
  for (const double progress : {0.0, 0.5, 1.0}) {
    start_row(plan, *params, posture, row);
    const ScriptInput in{progress, 1.0, progress, &level, {}};
    if (Result<Done> done = host.run(plan, *params, in, row); !done) return done;
  }
  return Done{};
}

}  // namespace contort
