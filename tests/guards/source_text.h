// The project's own files as text, for the guards: tests that read the source instead of running it.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace contort::guards {

struct SourceFile {
  std::string path;  // path from the project's root, "model/core/math.h"
  std::string text;
};

struct Violation {
  std::string path;
  int line = 0;  // 1 = first; 0 = the whole file
  std::string what;
};

inline std::string to_text(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& v : violations) text += v.path + ":" + std::to_string(v.line) + ": " + v.what + "\n";
  return text;
}

inline bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// All files of the project as in a checkout, without ignored files and hidden folders.
inline std::vector<SourceFile> project_files() {
  namespace fs = std::filesystem;
  constexpr std::array kIgnored = {"build", "contort-out", "report", ".git"};
  const fs::path root = CONTORT_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator(); ++it) {
    const std::string name = it->path().filename().string();
    const bool hidden = name.starts_with(".") && name != ".ci" && name != ".gitignore";
    const bool ignored = it.depth() == 0 && std::ranges::find(kIgnored, name) != kIgnored.end();
    if (it->is_directory() && (hidden || ignored)) it.disable_recursion_pending();
    if (!it->is_regular_file() || it->is_symlink() || hidden || ignored) continue;
    std::ostringstream text;
    text << std::ifstream(it->path(), std::ios::binary).rdbuf();
    files.push_back({it->path().lexically_relative(root).generic_string(), text.str()});
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

inline bool is_cpp(std::string_view path) { return path.ends_with(".cpp") || path.ends_with(".h"); }

// Blanks comments and the contents of literals, so that only code remains; lines and columns stay. The quoted path of
// an #include stays too.
class CodeOf {
 public:
  explicit CodeOf(std::string_view text) : text_(text), code_(text) {
    while (at_ < text_.size()) step();
  }
  std::string take() { return std::move(code_); }

 private:
  void step() {
    const char c = text_[at_];
    if (text_.substr(at_, 2) == "//") {
      blank_to(std::min(text_.find('\n', at_), text_.size()));
    } else if (text_.substr(at_, 2) == "/*") {
      blank_through("*/", at_ + 2);
    } else if (c == '"' && at_ > 0 && text_[at_ - 1] == 'R') {
      const std::size_t open = std::min(text_.find('(', at_), text_.size());
      blank_through(")" + std::string(text_.substr(at_ + 1, open - at_ - 1)) + "\"", open);
    } else if (c == '"' && on_include_line()) {
      at_ = std::min(text_.find('"', at_ + 1), text_.size() - 1) + 1;
    } else if (c == '"' || (c == '\'' && !is_digit_separator())) {
      blank_literal(c);
    } else {
      ++at_;
    }
  }

  void blank_to(std::size_t end) {
    for (; at_ < end; ++at_) {
      if (text_[at_] != '\n') code_[at_] = ' ';
    }
  }

  void blank_through(std::string_view mark, std::size_t from) {
    const std::size_t found = text_.find(mark, from);
    blank_to(found == std::string_view::npos ? text_.size() : found + mark.size());
  }

  void blank_literal(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote && text_[end] != '\n') end += text_[end] == '\\' ? 2 : 1;
    ++at_;  // the quotes stay as a placeholder
    blank_to(std::min(end, text_.size()));
    ++at_;
  }

  bool on_include_line() const {
    const std::size_t line = code_.rfind('\n', at_) + 1;  // npos + 1 is 0
    std::string before = code_.substr(line, at_ - line);
    std::erase_if(before, [](char c) { return c == ' ' || c == '\t'; });
    return before == "#include";
  }

  bool is_digit_separator() const {  // 1'000'000
    std::size_t start = at_;
    while (start > 0 && (is_word(text_[start - 1]) || text_[start - 1] == '\'')) --start;
    return start < at_ && std::isdigit(static_cast<unsigned char>(text_[start])) != 0;
  }

  std::string_view text_;
  std::string code_;
  std::size_t at_ = 0;
};

inline std::string code_of(std::string_view text) { return CodeOf(text).take(); }

struct Include {
  int line = 0;
  char open = 0;     // '"', '<', or 0 for a macro
  std::string name;  // "model/core/math.h", "vector"
};

inline std::vector<Include> includes_of(std::string_view text) {
  std::vector<Include> includes;
  std::istringstream lines(code_of(text));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto skip_space = [&line](std::size_t at) {
      return std::min(line.find_first_not_of(" \t", at), line.size());
    };
    std::size_t at = skip_space(0);
    if (at == line.size() || line[at] != '#') continue;
    at = skip_space(at + 1);
    if (line.compare(at, 7, "include") != 0) continue;
    at = skip_space(at + 7);
    const char open = at < line.size() && (line[at] == '"' || line[at] == '<') ? line[at] : '\0';
    const std::size_t start = open == '\0' ? at : at + 1;
    const std::size_t end = open == '\0' ? line.size() : line.find(open == '<' ? '>' : '"', start);
    includes.push_back({number, open, line.substr(start, end - start)});
  }
  return includes;
}

}  // namespace contort::guards
