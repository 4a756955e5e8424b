// Lets Contort test a MuJoCo model whose bodies hang on hinges: the action `command` sets the controls of its
// actuators. Build it with `g++ -std=c++17 -O2 mujoco_guest.cpp -lmujoco -o mujoco_guest`; the model is its argument.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "../cpp/contort_guest.h"

namespace {

// The hinge of a body; -1 if the body is fixed to its parent.
int hinge_of(const mjModel& model, int body) {
  const int joint = model.body_jntnum[body] == 1 ? model.body_jntadr[body] : -1;
  return joint >= 0 && model.jnt_type[joint] == mjJNT_HINGE ? joint : -1;
}

std::string numbers(const mjtNum* values, std::initializer_list<int> order) {
  std::ostringstream out;
  for (const int i : order) out << (out.tellp() > 0 ? "," : "[") << values[i];
  return out.str() + "]";
}

std::string joint_json(const mjModel& model, int body) {
  std::ostringstream out;
  out << R"({"name":")" << mj_id2name(&model, mjOBJ_BODY, body) << '"';
  if (body == 0) return out.str() + R"(,"type":"fixed"})";
  out << R"(,"parent":")" << mj_id2name(&model, mjOBJ_BODY, model.body_parentid[body]) << R"(","position":)"
      << numbers(model.body_pos + 3 * body, {0, 1, 2}) << R"(,"rotation":)"
      << numbers(model.body_quat + 4 * body, {1, 2, 3, 0});
  const int hinge = hinge_of(model, body);
  if (hinge < 0) return out.str() + R"(,"type":"fixed"})";
  out << R"(,"type":"hinge","axis":)" << numbers(model.jnt_axis + 3 * hinge, {0, 1, 2});
  constexpr double kDeg = 180.0 / mjPI;
  if (model.jnt_limited[hinge])
    out << R"(,"low_deg":)" << model.jnt_range[2 * hinge] * kDeg << R"(,"high_deg":)"
        << model.jnt_range[2 * hinge + 1] * kDeg;
  return out.str() + "}";
}

std::string manifest_of(const mjModel& model) {
  std::ostringstream out;
  out << R"({"contort":1,"name":"mujoco","build":")" << mj_versionString()
      << R"(","convention":{"up":"+z","forward":"+x"},"characters":[{"name":"model","joints":[)";
  for (int body = 0; body < model.nbody; ++body) out << (body > 0 ? "," : "") << joint_json(model, body);
  out << R"(]}],"actions":[{"name":"command","help":"Sets the controls of the actuators.","params":{)";
  for (int i = 0; i < model.nu; ++i)
    out << (i > 0 ? "," : "") << '"' << mj_id2name(&model, mjOBJ_ACTUATOR, i) << R"(":{"type":"number","low":)"
        << model.actuator_ctrlrange[2 * i] << R"(,"high":)" << model.actuator_ctrlrange[2 * i + 1] << '}';
  return out.str() + "}}]}";
}

void generate(const mjModel& model, const contort_guest::Request& request, contort_guest::Motion& motion) {
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(&model), mj_deleteData);
  for (int frame = 0; frame < motion.frames(); ++frame) {
    for (const contort_guest::Use& use : request.uses)
      if (use.start_frame == frame)
        for (int i = 0; i < model.nu; ++i)
          data->ctrl[i] = use.params[mj_id2name(&model, mjOBJ_ACTUATOR, i)].number;
    while (data->time < frame / request.rate_hz) mj_step(&model, data.get());
    for (int body = 1; body < model.nbody; ++body) {
      const int hinge = hinge_of(model, body);
      if (hinge < 0) continue;
      const mjtNum* axis = model.jnt_axis + 3 * hinge;
      const double angle_deg = data->qpos[model.jnt_qposadr[hinge]] * 180.0 / mjPI;
      motion.turn(frame, body, {axis[0], axis[1], axis[2]}, angle_deg);
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  char error[1000] = "name a model in MJCF";
  const std::unique_ptr<mjModel, void (*)(mjModel*)> model(
      count == 2 ? mj_loadXML(arguments[1], nullptr, error, sizeof error) : nullptr, mj_deleteModel);
  if (!model) {
    std::cerr << error << '\n';
    return 1;
  }
  return contort_guest::serve(manifest_of(*model), [&](const auto& request, auto& motion) {
    generate(*model, request, motion);
  });
}
