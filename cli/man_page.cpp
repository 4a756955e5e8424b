#include "cli/man_page.h"

#include <sstream>

namespace contort::cli {

namespace {

// Escapes text for roff: backslashes and hyphens are printed as they are, and no line is interpreted as a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool begins_line = out.empty() || out.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

// Prints lines unchanged, in the font of examples.
std::string verbatim(const std::string& text) { return ".PP\n.nf\n" + roff(text) + "\n.fi\n"; }

std::string heading_of(const OptionEntry& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  if (!option.value.empty()) names += (names.empty() ? "\\fI" : " \\fI") + roff(option.value) + "\\fR";
  return names + (option.may_repeat ? " ..." : "");
}

std::string item_of(const OptionEntry& option) {
  std::string text = ".TP\n" + heading_of(option) + "\n" + roff(option.about);
  if (!option.default_value.empty()) text += " (default: " + roff(option.default_value) + ")";
  return text + (option.is_required ? " (required)\n" : "\n");
}

std::string items_of(const CommandEntry& command) {
  std::string text;
  for (const OptionEntry& option : command.options) text += item_of(option);
  return text;
}

// Text such as "contort check [OPTIONS] FILE".
std::string usage_of(const CommandEntry& command) {
  std::string text = "\\fBcontort " + roff(command.name) + "\\fR [\\fIOPTIONS\\fR]";
  for (const OptionEntry& option : command.options) {
    if (!option.is_positional()) continue;
    const std::string word = "\\fI" + roff(option.value) + "\\fR" + (option.may_repeat ? " ..." : "");
    text += option.is_required ? " " + word : " [" + word + "]";
  }
  return text + (command.commands.empty() ? "\n" : " \\fICOMMAND\\fR\n");
}

std::string section_of(const CommandEntry& command) {
  return ".SS contort " + roff(command.name) + "\n" + roff(command.about) + ".\n.PP\n" + usage_of(command) +
         items_of(command) + (command.footer.empty() ? "" : verbatim(command.footer));
}

}  // namespace

std::string man_page(std::span<const CommandEntry> commands, const std::string& version) {
  const CommandEntry& program = commands.front();
  std::ostringstream page;
  page << ".TH CONTORT 1 \"\" \"contort " << version << "\" \"User Commands\"\n"
       << ".SH NAME\ncontort \\- find the motions that an animation generator should never produce\n"
       << ".SH SYNOPSIS\n\\fBcontort\\fR [\\fIOPTIONS\\fR] \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n"
       << ".SH DESCRIPTION\n"
       << roff(program.about) << "\n"
       << ".SH OPTIONS\nThese options may also follow the command.\n"
       << items_of(program) << ".SH COMMANDS\n";
  for (const CommandEntry& command : commands.subspan(1)) page << section_of(command);
  page << ".SH EXIT STATUS\n"
       << verbatim(program.footer)
       << ".SH SEE ALSO\nThe pages in share/doc/contort of the installation, beginning with guide/README.md.\n";
  return page.str();
}

}  // namespace contort::cli
