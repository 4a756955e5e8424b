// Writes the report about guessed data.
#include <cstdio>

#include "import/import.h"

namespace contort {

namespace {

std::string number(double value, const char* format = "%.4g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Makes untrusted names safe as text between backquotes of a table.
std::string plain(const std::string& text, std::size_t most) {
  std::string out;
  for (const char c : text.substr(0, most))
    out += c == '|' || c == '`' || c == '<' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return out;
}
std::string quoted_cell(const std::string& text) { return "`" + plain(text, 80) + "`"; }

std::string range_of(const BoneJoint& joint) {
  const std::string interval = number(joint.low_deg) + " to " + number(joint.high_deg);
  if (joint.is_pair)
    return "hinges " + interval + ", " + number(joint.second_low_deg) + " to " + number(joint.second_high_deg);
  if (joint.type == JointType::hinge) return "hinge " + interval;
  return "swing " + number(joint.swing_deg[0]) + " x " + number(joint.swing_deg[1]) + ", twist " + interval;
}

std::string what_we_know(const Bone& bone) {
  if (bone.from_vrm) return "VRM";
  return bone.family == BoneFamily::unknown ? "place" : "name";
}

std::string bone_rows(const Imported& in) {
  std::string out = "| node | joint | known by | surface points | range, degrees | from |\n|---|---|---|---|---|---|\n";
  for (std::size_t b = 0; b < in.figure.bones.size(); ++b) {
    const Bone& bone = in.figure.bones[b];
    const BoneReport& report = in.cut.bones[b];
    out += "| " + quoted_cell(bone.label) + " | " + report.joint + " | " + what_we_know(bone) + " | " +
           std::to_string(bone.points_m.size()) + " | ";
    out += b == 0 ? "| |\n"
                  : range_of(report.limits) + " | " + std::string(source_name(report.limits.source)) +
                        (report.limits.leaves_table ? ", which its own clips leave" : "") + " |\n";
  }
  return out;
}

std::string contact_rows(const OwnContacts& contacts) {
  std::string out;
  for (const AllowedPairDesc& pair : contacts.pairs) out += "* " + pair.a + " ~ " + pair.b + ": " + pair.reason + "\n";
  if (contacts.left_out > 0)
    out += "* and " + std::to_string(contacts.left_out) + " more, which a character's file has no place for\n";
  return out.empty() ? "None.\n" : out;
}

}  // namespace

std::string_view source_name(LimitSource source) {
  switch (source) {
    case LimitSource::table: return "table of people";
    case LimitSource::clips: return "own clips";
    case LimitSource::generic: return "nothing: generic";
  }
  return "";
}

std::string write_report(const Imported& in, const std::string& name) {
  const RiggedFigure& figure = in.figure;
  std::string out = "# " + name + ": what was guessed\n\n";
  out += std::string("Taken for ") +
         (figure.is_humanoid    ? "a humanoid"
          : figure.is_quadruped ? "a quadruped"
                                : "neither humanoid nor quadruped") +
         ". " + number(figure.height_m) + " m high, " + number(in.mass_kg) + " kg (" +
         (weighs_as_human(figure) ? "24.1 kg/m2 times height squared, in de Leva's shares"
                                  : "1000 kg/m3 of its colliders") +
         "), " + std::to_string(figure.bones.size()) + " bones in " + std::to_string(in.cut.parts.size()) + " parts, " +
         std::to_string(figure.vertex_count) + " vertices; " + number(figure.metres_per_unit) + " m to a unit.\n\n";
  for (const std::string& note : figure.notes) out += "* " + plain(note, 400) + "\n";
  out += "\n## Joints\n\n" + bone_rows(in) + "\n## Contacts that are allowed\n\n" + contact_rows(in.contacts);
  return out;
}

}  // namespace contort
