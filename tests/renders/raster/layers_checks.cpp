// Each instance is drawn in exactly one pass, which its flags choose.
#include "renders/raster/layers.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

DrawInstance instance_of(int highlight, bool ghost, bool mark, bool on_top) {
  DrawInstance instance;
  instance.highlight = highlight, instance.ghost = ghost, instance.mark = mark, instance.on_top = on_top;
  return instance;
}

TEST(Layers, EachInstanceIsDrawnOnce) {
  for (int bits = 0; bits < 16; ++bits) {
    const DrawInstance instance = instance_of(bits & 1, bits & 2, bits & 4, bits & 8);
    if (instance.ghost && instance.on_top) continue;  // nothing is both
    EXPECT_EQ(is_opaque(instance) + is_ghost_figure(instance) + is_translucent(instance) + instance.on_top, 1) << bits;
  }
}

TEST(Layers, HighlightsAndOpaqueMarksShineThrough) {
  EXPECT_FALSE(shines_through({}));
  EXPECT_TRUE(shines_through(instance_of(1, false, false, false)));
  EXPECT_TRUE(shines_through(instance_of(0, false, true, false)));
  EXPECT_FALSE(shines_through(instance_of(0, true, true, false)));
  EXPECT_FALSE(shines_through(instance_of(0, false, true, true))) << "nothing hides it";
}

TEST(Layers, OnlyFiguresCastShadows) {
  EXPECT_TRUE(casts_shadow(instance_of(1, false, false, false)));
  EXPECT_FALSE(casts_shadow(instance_of(0, true, false, false)));
  EXPECT_FALSE(casts_shadow(instance_of(0, false, true, false)));
}

}  // namespace
}  // namespace contort
