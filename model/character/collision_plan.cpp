// Finds the colliders of each body, and the pairs of bodies that may not touch.
#include <algorithm>
#include <map>

#include "model/character/assembly.h"

namespace contort {

namespace {

// The owner in a collider's name: "arm_left" for "arm_left/forearm", "object:rifle" for "object:rifle/barrel".
std::string owner_of(const Collider& collider) { return collider.name.substr(0, collider.name.find('/')); }

std::string body_name(const Assembly& assembly, const Collider& collider) {
  const Joint& joint = assembly.joints[static_cast<std::size_t>(collider.joint)];
  const std::string owner = owner_of(collider);
  const bool own_joint = joint.name.compare(0, owner.size() + 1, owner + "/") == 0;
  return own_joint ? owner + "/" + joint.body_name : owner;
}

// For each joint, the body that carries its body. Massless links in between are axes of one anatomical joint, not
// bodies.
std::vector<int> find_carriers(const Assembly& assembly) {
  std::vector<char> solid(assembly.joints.size(), 0);
  for (const Collider& collider : assembly.colliders) solid[static_cast<std::size_t>(collider.joint)] = 1;
  std::vector<int> carriers;
  for (const Joint& joint : assembly.joints) {
    const auto parent = static_cast<std::size_t>(joint.parent);
    const bool on_link = joint.parent > 0 && solid[parent] == 0 && assembly.joints[parent].mass_kg <= 0.0;
    carriers.push_back(on_link ? carriers[parent] : joint.parent);
  }
  return carriers;
}

const char* kinship(const std::vector<int>& carriers, int joint_a, int joint_b) {
  if (joint_a == joint_b) return "same_body";
  if (carriers[static_cast<std::size_t>(joint_a)] == joint_b || carriers[static_cast<std::size_t>(joint_b)] == joint_a)
    return "adjacent";
  return nullptr;
}

}  // namespace

std::vector<Body> group_colliders(Assembly& assembly) {
  std::stable_sort(assembly.colliders.begin(), assembly.colliders.end(), [](const Collider& l, const Collider& r) {
    return l.joint != r.joint ? l.joint < r.joint : owner_of(l) < owner_of(r);
  });
  std::vector<Body> bodies;
  for (std::size_t c = 0; c < assembly.colliders.size(); ++c) {
    const Collider& collider = assembly.colliders[c];
    std::string name = body_name(assembly, collider);
    if (bodies.empty() || bodies.back().joint != collider.joint || bodies.back().name != name)
      bodies.push_back({std::move(name), collider.joint, static_cast<int>(c), 0});
    ++bodies.back().collider_count;
  }
  return bodies;
}

CollisionPlan plan_collisions(const Assembly& assembly, std::vector<Body> bodies,
                              const std::vector<AllowedPair>& by_user) {
  CollisionPlan plan;
  plan.bodies = std::move(bodies);
  const std::vector<int> carriers = find_carriers(assembly);
  std::map<std::pair<int, int>, const AllowedPair*> named;  // the first of several equal pairs
  for (const AllowedPair& pair : by_user) named.try_emplace({pair.a, pair.b}, &pair);
  const auto sort_pair = [&](int a, int b, const char* kin) {
    const auto user = named.find({a, b});
    if (kin != nullptr)
      plan.allowed.push_back({a, b, kin});
    else if (user != named.end())
      plan.allowed.push_back(*user->second);
    else
      plan.colliders.push_back({a, b});
  };
  for (std::size_t i = 0; i < plan.bodies.size(); ++i)
    for (std::size_t k = i; k < plan.bodies.size(); ++k) {
      const Body& a = plan.bodies[i];
      const Body& b = plan.bodies[k];
      const char* kin = kinship(carriers, a.joint, b.joint);
      const int first = static_cast<int>(plan.colliders.size());
      for (int ca = a.first_collider; ca < a.first_collider + a.collider_count; ++ca)
        for (int cb = i == k ? ca + 1 : b.first_collider; cb < b.first_collider + b.collider_count; ++cb)
          sort_pair(ca, cb, kin);
      const int count = static_cast<int>(plan.colliders.size()) - first;
      if (count > 0) plan.judged.push_back({static_cast<int>(i), static_cast<int>(k), first, count});
    }
  return plan;
}

}  // namespace contort
