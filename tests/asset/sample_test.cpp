#include "model/asset/sample.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace contort {
namespace {

const Vec3 kZ(0, 0, 1);

void push(std::vector<double>& values, const Quat& q) { values.insert(values.end(), {q.x, q.y, q.z, q.w}); }

// Rotations about z by the given angles, a key every second.
AssetChannel turns(const std::vector<double>& angles_rad, Interpolation interpolation) {
  AssetChannel out;
  out.path = ChannelPath::rotation;
  out.interpolation = interpolation;
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    out.times_s.push_back(static_cast<double>(i));
    if (interpolation == Interpolation::cubic_spline) out.values.resize(out.values.size() + 4);
    push(out.values, axis_angle(kZ, angles_rad[i]));
    if (interpolation == Interpolation::cubic_spline) out.values.resize(out.values.size() + 4);
  }
  return out;
}

AssetChannel moves(const std::vector<double>& values, Interpolation interpolation) {
  const std::size_t rows = interpolation == Interpolation::cubic_spline ? 9 : 3;
  AssetChannel out;
  out.interpolation = interpolation;
  out.values = values;
  for (std::size_t i = 0; i < values.size() / rows; ++i) out.times_s.push_back(static_cast<double>(i));
  return out;
}

double angle_between(const Quat& a, const Quat& b) { return rotation_angle(glm::conjugate(a) * b); }

TEST(Sample, LinearVectorsGoStraight) {
  const AssetChannel c = moves({0, 0, 0, 2, 4, 8}, Interpolation::linear);
  EXPECT_EQ(sample_vector(c, 0.25), Vec3(0.5, 1, 2));
}

TEST(Sample, LinearRotationsTurnEvenly) {
  const AssetChannel c = turns({0.0, 1.0}, Interpolation::linear);
  for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0})
    EXPECT_NEAR(angle_between(sample_rotation(c, t), axis_angle(kZ, t)), 0.0, 1e-14) << t;
}

TEST(Sample, StepHoldsUntilTheNextKey) {
  const AssetChannel c = moves({0, 0, 0, 1, 1, 1}, Interpolation::step);
  EXPECT_EQ(sample_vector(c, 0.999), Vec3(0.0));
  EXPECT_EQ(sample_vector(c, 1.0), Vec3(1.0));
  const AssetChannel r = turns({0.0, 1.0}, Interpolation::step);
  EXPECT_EQ(sample_rotation(r, 0.999), kNoRotation);
}

// Computed by hand from appendix C of the standard, at t = 1/2 with a key distance of 2 s: v0/2 + b0/4 + v1/2 - a1/4.
TEST(Sample, SplinesFollowTheStandard) {
  AssetChannel c = moves({9, 9, 9, 1, 0, 0, 8, 0, 0, 4, 0, 0, 3, 0, 0, 9, 9, 9}, Interpolation::cubic_spline);
  c.times_s = {1.0, 3.0};
  EXPECT_NEAR(sample_vector(c, 2.0).x, 0.5 * 1 + 0.25 * 8 + 0.5 * 3 - 0.25 * 4, 1e-15);
  EXPECT_EQ(sample_vector(c, 1.0).x, 1.0);
  EXPECT_EQ(sample_vector(c, 3.0).x, 3.0);
}

TEST(Sample, SplinesOfRotationsAreUnit) {
  AssetChannel c = turns({0.0, 2.0, -1.0}, Interpolation::cubic_spline);
  c.values[8] = 3.0;  // an out-tangent
  for (double t = 0.0; t <= 2.0; t += 0.01) EXPECT_NEAR(glm::length(sample_rotation(c, t)), 1.0, 1e-15);
}

TEST(Sample, ASplineThroughNoRotationStaysAtTheKeyBefore) {
  AssetChannel c = turns({0.0, 0.0}, Interpolation::cubic_spline);
  c.values[4 * 4 + 3] = -1.0;  // from q to -q without tangents: 0 in the middle
  EXPECT_EQ(sample_rotation(c, 0.5), kNoRotation);
}

TEST(Sample, OutsideOfTheKeysTheNearestOneHolds) {
  for (const auto interpolation : {Interpolation::step, Interpolation::linear}) {
    AssetChannel c = moves({1, 1, 1, 2, 2, 2}, interpolation);
    c.times_s = {5.0, 6.0};
    EXPECT_EQ(sample_vector(c, -1.0), Vec3(1.0));
    EXPECT_EQ(sample_vector(c, 100.0), Vec3(2.0));
  }
  EXPECT_EQ(sample_vector(moves({1, 2, 3}, Interpolation::linear), 0.5), Vec3(1, 2, 3));
}

TEST(Sample, APoseIsTheRestWithWhatTheClipMoves) {
  Asset asset;
  asset.nodes.resize(3);
  asset.nodes[0].rest.translation = {1, 2, 3};
  asset.nodes[2].rest.scale = {4, 4, 4};
  AssetClip clip;
  clip.channels = {turns({0.0, 1.0}, Interpolation::linear), moves({0, 0, 0, 2, 2, 2}, Interpolation::linear)};
  clip.channels[0].node = 2;
  clip.channels[1].node = 1;
  clip.channels[1].path = ChannelPath::scale;
  const std::vector<Trs> out = pose(asset, clip, 0.5);
  EXPECT_EQ(out[0], asset.nodes[0].rest);
  EXPECT_EQ(out[1].scale, Vec3(1.0));
  EXPECT_EQ(out[2].scale, Vec3(4.0));
  EXPECT_NEAR(angle_between(out[2].rotation, axis_angle(kZ, 0.5)), 0.0, 1e-14);
}

// ---- speeds

TEST(JointSpeeds, AreAngleOverTimeBetweenKeys) {
  AssetClip clip;
  clip.channels = {moves({0, 0, 0, 1, 1, 1}, Interpolation::linear), turns({0.0, 1.0, 0.5}, Interpolation::linear)};
  clip.channels[1].node = 7;
  clip.channels[1].times_s = {0.0, 0.5, 2.0};
  const auto speeds = joint_speeds(clip);
  ASSERT_EQ(speeds.size(), 1U);
  EXPECT_EQ(speeds[0].channel, 1);
  EXPECT_EQ(speeds[0].node, 7);
  ASSERT_EQ(speeds[0].between_keys.size(), 2U);
  EXPECT_NEAR(speeds[0].between_keys[0].speed_rad_s, 2.0, 1e-14);
  EXPECT_NEAR(speeds[0].between_keys[1].speed_rad_s, 0.5 / 1.5, 1e-14);
  EXPECT_EQ(speeds[0].between_keys[1].t0_s, 0.5);
  EXPECT_EQ(speeds[0].between_keys[1].t1_s, 2.0);
  EXPECT_TRUE(speeds[0].within_keys.empty());
}

// A person cannot see two keys that are a microsecond apart, or at one time; only the jump from frame to frame is
// visible.
TEST(JointSpeeds, KeysCloserThanAFrameAreOneJumpBetweenFrames) {
  for (const double apart_s : {0.0, 1e-6, 1e-3}) {
    AssetClip clip;
    clip.channels = {turns({0.0, 0.0, 0.1, 0.1}, Interpolation::linear)};
    clip.channels[0].times_s = {0.0, 0.5, 0.5 + apart_s, 1.0};
    const auto speeds = joint_speeds(clip)[0].between_keys;
    ASSERT_EQ(speeds.size(), 3U);
    EXPECT_EQ(speeds[0].speed_rad_s, 0.0) << apart_s;
    EXPECT_NEAR(speeds[1].speed_rad_s, 0.1 * 60.0, 1e-9) << apart_s;
    EXPECT_NEAR(speeds[1].t1_s - speeds[1].t0_s, 1.0 / 60.0, 1e-12) << apart_s;
  }
}

TEST(JointSpeeds, KeysOfFastCamerasAreJudgedOneByOne) {
  AssetClip clip;
  clip.channels = {turns({0.0, 0.0, 0.1, 0.1}, Interpolation::linear)};
  for (double& t : clip.channels[0].times_s) t /= 120.0;
  EXPECT_NEAR(joint_speeds(clip)[0].between_keys[1].speed_rad_s, 0.1 * 120.0, 1e-9);
}

TEST(JointSpeeds, AStepHoldsAndJumpsInAFrame) {
  AssetClip clip;
  clip.channels = {turns({0.0, 1.0, 1.0}, Interpolation::step)};
  const ChannelSpeeds speeds = joint_speeds(clip)[0];
  EXPECT_TRUE(speeds.jumps);
  ASSERT_EQ(speeds.between_keys.size(), 2U);
  EXPECT_NEAR(speeds.between_keys[0].speed_rad_s, 60.0, 1e-9);
  EXPECT_NEAR(speeds.between_keys[0].t0_s, 1.0 - 1.0 / 60.0, 1e-12);
  EXPECT_EQ(speeds.between_keys[0].t1_s, 1.0);
  EXPECT_EQ(speeds.between_keys[1].speed_rad_s, 0.0);
}

// A motion that is written as STEP at 30 Hz is as fast as with linear interpolation between the keys.
TEST(JointSpeeds, OfAMotionThatWasSampledAndWrittenAsStepAreThoseOfItsRate) {
  for (const auto interpolation : {Interpolation::step, Interpolation::linear}) {
    AssetClip clip;
    clip.channels = {turns({0.0, 0.1, 0.2, 0.3}, interpolation)};
    for (double& t : clip.channels[0].times_s) t /= 30.0;
    const ChannelSpeeds speeds = joint_speeds(clip)[0];
    for (const SpeedInterval& step : speeds.between_keys) EXPECT_NEAR(step.speed_rad_s, 0.1 * 30.0, 1e-9);
  }
}

TEST(JointSpeeds, OfASplineAreTakenInsideOfTheKeysToo) {
  AssetClip clip;
  clip.channels = {turns({0.0, 1.0}, Interpolation::cubic_spline)};
  const auto speeds = joint_speeds(clip)[0];
  ASSERT_EQ(speeds.between_keys.size(), 1U);
  ASSERT_EQ(speeds.within_keys.size(), 1U);
  EXPECT_NEAR(speeds.between_keys[0].speed_rad_s, 1.0, 1e-14);
  // The spline starts and ends at rest: 3/2 of the mean speed in the middle of the chord, which is nearer to 0 than the
  // circle.
  EXPECT_NEAR(speeds.within_keys[0].speed_rad_s, 1.5 * 2.0 * std::tan(0.25) / 0.5, 0.015 * 1.6);
  EXPECT_NEAR(0.5 * (speeds.within_keys[0].t0_s + speeds.within_keys[0].t1_s), 0.5, 1e-12);
}

// Keys of opposite sign, without tangents that lead around: the spline passes near 0 and turns there within a frame.
TEST(JointSpeeds, ASplineBetweenOppositeKeysIsAsFastAsItIs) {
  AssetClip clip;
  clip.channels = {turns({0.0, 0.2}, Interpolation::cubic_spline)};
  for (std::size_t i = 16; i < 20; ++i) clip.channels[0].values[i] = -clip.channels[0].values[i];
  const ChannelSpeeds speeds = joint_speeds(clip)[0];
  EXPECT_LT(speeds.between_keys[0].speed_rad_s, 1.0);
  EXPECT_GT(speeds.within_keys[0].speed_rad_s, 10.0);
  EXPECT_LE(speeds.within_keys[0].speed_rad_s, kPi * 60.0);
}

// ---- laws

AssetChannel any_turns() {
  const auto angles = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::vector<int>>>(
      rc::gen::container<std::vector<int>>(3, rc::gen::inRange(-300, 300))));
  AssetChannel out;
  out.path = ChannelPath::rotation;
  for (const std::vector<int>& a : angles) {
    out.times_s.push_back(static_cast<double>(out.times_s.size()) / 3.0);
    push(out.values, from_rotation_vector(Vec3(a[0], a[1], a[2]) / 100.0));
  }
  return out;
}

// q and -q are one rotation. Almost every real file flips signs between keys.
RC_GTEST_PROP(SampleProperty, SignsOfKeysDoNotMatter, ()) {
  AssetClip clip;
  clip.channels = {any_turns()};
  AssetClip flipped = clip;
  std::vector<double>& values = flipped.channels[0].values;
  for (std::size_t key = 0; key < values.size() / 4; ++key)
    if (*rc::gen::arbitrary<bool>())
      for (std::size_t i = 0; i < 4; ++i) values[4 * key + i] = -values[4 * key + i];
  const double t = *rc::gen::inRange(-10, 400) / 97.0;
  const double angle = angle_between(sample_rotation(clip.channels[0], t), sample_rotation(flipped.channels[0], t));
  const auto speeds = joint_speeds(clip)[0].between_keys;
  const auto flipped_speeds = joint_speeds(flipped)[0].between_keys;
  bool half_turn = false;  // there both ways are equally short, and the signs choose
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    RC_ASSERT(std::fabs(speeds[i].speed_rad_s - flipped_speeds[i].speed_rad_s) < 1e-9);
    half_turn = half_turn || speeds[i].speed_rad_s / 3.0 > kPi - 1e-6;
  }
  if (!half_turn) RC_ASSERT(angle < 1e-7);
}

RC_GTEST_PROP(SampleProperty, KeysAreMetAtTheirTimes, ()) {
  const AssetChannel c = any_turns();
  for (std::size_t key = 0; key < c.times_s.size(); ++key) {
    const double* v = c.values.data() + 4 * key;
    RC_ASSERT(angle_between(sample_rotation(c, c.times_s[key]), Quat(v[3], v[0], v[1], v[2])) < 1e-12);
  }
}

RC_GTEST_PROP(SampleProperty, NoMomentOfASplineIsFasterThanItsPeak, ()) {
  AssetClip clip;
  clip.channels = {turns({0.0, *rc::gen::inRange(-300, 300) / 100.0}, Interpolation::cubic_spline)};
  AssetChannel& channel = clip.channels[0];
  for (const std::size_t first : {std::size_t{8}, std::size_t{12}})  // the tangents inside
    for (std::size_t i = 0; i < 4; ++i) channel.values[first + i] = *rc::gen::inRange(-300, 300) / 100.0;
  const double peak = joint_speeds(clip)[0].within_keys[0].speed_rad_s;
  constexpr double dt = 2e-4;
  double sampled = 0.0;
  for (double t = 0.0; t + dt <= 1.0; t += dt)
    sampled = std::max(sampled, angle_between(sample_rotation(channel, t), sample_rotation(channel, t + dt)) / dt);
  RC_ASSERT(peak > 0.989 * std::min(sampled, kPi * 60.0));
  if (sampled < 10.0) RC_ASSERT(peak < 1.01 * sampled + 0.01);
}

// Between two keys a linear rotation has the speed of joint_speeds everywhere.
RC_GTEST_PROP(SampleProperty, LinearRotationsKeepTheirSpeed, ()) {
  AssetClip clip;
  clip.channels = {any_turns()};
  const ChannelSpeeds speeds = joint_speeds(clip)[0];
  for (const SpeedInterval& part : speeds.between_keys) {
    const double t = part.t0_s + 0.3 * (part.t1_s - part.t0_s);
    const double dt = 0.1 * (part.t1_s - part.t0_s);
    const double angle = angle_between(sample_rotation(clip.channels[0], t), sample_rotation(clip.channels[0], t + dt));
    RC_ASSERT(std::fabs(angle / dt - part.speed_rad_s) < 1e-6);
  }
}

}  // namespace
}  // namespace contort
