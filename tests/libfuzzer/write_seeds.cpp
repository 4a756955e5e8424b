// contort_seeds DIR: the seeds of each target as DIR/<target>/seed_<i>, and its words as DIR/<target>.dict, for
// libFuzzer.
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include "tests/corpus/temp_folder.h"
#include "tests/libfuzzer/targets.h"

namespace {

using namespace contort;
using namespace contort::hostile;

constexpr std::size_t kLongestWord = 32;

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Names, keys and key words: two letters or more, with the quotes around them where there are any.
void add_words(const std::string& text, std::set<std::string>& words) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_of_word(text[end])) ++end;
    const bool is_quoted = at > 0 && end < text.size() && text[at - 1] == '"' && text[end] == '"';
    const std::string word = text.substr(at, end - at);
    if (word.size() >= 2 && word.size() <= kLongestWord && std::isalpha(static_cast<unsigned char>(word[0])) != 0)
      words.insert(is_quoted ? "\\\"" + word + "\\\"" : word);
    at = end + 1;
  }
}

void write(const Target& target, const std::string& folder) {
  const std::string name(target.name);
  std::filesystem::create_directories(folder + "/" + name);
  std::set<std::string> words;
  int count = 0;
  for (const std::string& seed : target.seeds()) {
    spill(folder + "/" + name + "/seed_" + std::to_string(count++), seed);
    add_words(seed, words);
  }
  const std::string schema = std::string(CONTORT_SOURCE_DIR) + "/docs/schema/" + name + ".schema.json";
  if (std::filesystem::exists(schema)) add_words(slurp(schema), words);
  std::string dictionary;
  for (const std::string& word : words) dictionary += "\"" + word + "\"\n";
  spill(folder + "/" + name + ".dict", dictionary);
  std::printf("%-12s %3d seeds, %3zu words\n", name.c_str(), count, words.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: contort_seeds DIR\n"), 2;
  for (const Target& target : all_targets()) write(target, argv[1]);
}
