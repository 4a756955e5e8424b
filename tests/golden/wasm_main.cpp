// Prints the golden hashes as WebAssembly under Node: wasm_main SPECS. SPECS is a file with the output of the native
// program with --drawn-specs, because WebAssembly has neither threads nor the library that draws cases.
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "generator/built_in.h"
#include "tests/golden/hashes.h"

namespace contort::golden {

namespace {

// An empty line follows each of them.
std::vector<Spec> read_specs(const char* path) {
  std::vector<Spec> specs;
  std::ifstream file(path);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    text += line + "\n";
    if (!line.empty() || text == "\n") continue;
    specs.push_back(*parse_spec(text));
    text.clear();
  }
  return specs;
}

void print_drawn_of(const char* path) {
  BuiltInGenerator generator;
  Evaluator evaluator(generator);
  std::vector<std::uint64_t> hashes;
  for (const Spec& spec : read_specs(path)) hashes.push_back(hash_of(spec, evaluator));
  print_drawn(1, hashes);
}

}  // namespace

}  // namespace contort::golden

int main(int count, char** words) {
  if (count != 2) return std::fprintf(stderr, "usage: wasm_main SPECS\n"), 2;
  contort::golden::print_fixed();
  contort::golden::print_drawn_of(words[1]);
}
