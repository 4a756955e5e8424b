// A small skeleton and motion in the Acclaim formats, for tests.
#pragma once

#include <string>

namespace contort {

// Root, an arm with three degrees of freedom about an axis turned by 90 degrees, a hand with one, a nose with none.
inline std::string small_asf() {
  return "# made by hand\n"
         ":version 1.10\n"
         ":name tiny\n"
         ":units\n"
         "  mass 1.0\n"
         "  length 0.45\n"
         "  angle deg\n"
         ":documentation\n"
         "  begin and end mean nothing here\n"
         ":root\n"
         "  order TX TY TZ RX RY RZ\n"
         "  axis XYZ\n"
         "  position 0 1 0\n"
         "  orientation 0 0 0\n"
         ":bonedata\n"
         "  begin\n"
         "    id 1\n"
         "    name arm\n"
         "    direction 1 0 0\n"
         "    length 2.5\n"
         "    axis 0 0 90  XYZ\n"
         "    dof rx ry rz\n"
         "    limits (-90.0 90.0)\n"
         "           (-30.0 30.0)\n"
         "           (-inf inf)\n"
         "  end\n"
         "  begin\n"
         "    id 2\n"
         "    name hand\n"
         "    direction 1 0 0\n"
         "    length 0.5\n"
         "    axis 0 0 0 XYZ\n"
         "    dof ry\n"
         "    limits (0.0 45.0)\n"
         "  end\n"
         "  begin\n"
         "    id 3\n"
         "    name nose\n"
         "    direction 0 0 1\n"
         "    length 0.1\n"
         "    axis 0 0 0 XYZ\n"
         "  end\n"
         ":hierarchy\n"
         "  begin\n"
         "    root arm nose\n"
         "    arm hand\n"
         "  end\n";
}

// Four frames. The hand's limit is 45 and its numbers are 45, 46, 44 and -2; the arm stays in range except in frame 8.
inline std::string small_amc() {
  return "#!OML\n"
         ":FULLY-SPECIFIED\n"
         ":DEGREES\n"
         "6\nroot 1 2 3 0 0 0\nhand 45\narm 90 0 0\n"
         "7\nroot 1 2 3 0 0 0\narm 90 30 500\nhand 46\n"
         "8\nroot 1 2 3 0 0 0\nhand 44\narm 0 -31.5 0\n"
         "9\nroot 1 2 3 0 90 0\nhand -2\narm 0 0 0\n";
}

}  // namespace contort
