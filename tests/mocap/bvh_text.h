// Small BVH texts for tests.
#pragma once

#include <string>
#include <vector>

namespace contort {

// A hip that moves, a spine with another order of rotations and no offset, and an end site; two frames.
inline std::string small_bvh() {
  return "HIERARCHY\n"
         "ROOT Hips\n"
         "{\n"
         "  OFFSET 1.0 90.0 -2.0\n"
         "  CHANNELS 6 Zrotation Yrotation Xrotation Xposition Yposition Zposition\n"
         "  JOINT rig:Spine one\n"
         "  {\n"
         "    OFFSET 0 0 0\n"
         "    CHANNELS 3 Xrotation Yrotation Zrotation\n"
         "    End Site\n"
         "    {\n"
         "      OFFSET 0.0 1.25e1 0.0\n"
         "    }\n"
         "  }\n"
         "}\n"
         "MOTION\n"
         "Frames: 2\n"
         "Frame Time: 0.25\n"
         "90 0 0 10 20 30 0 0 0\n"
         "0 90 90 -1e-1 .5 +3 90 90 0\n";
}

// The text with the first occurrence of `what` replaced.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? "no " + what : text.replace(at, what.size(), by);
}

}  // namespace contort
