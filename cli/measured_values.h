// Measured values and limits of stored failures, for a report.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "checks/settings.h"
#include "corpus/case.h"
#include "model/character/library.h"

namespace contort::cli {

// Caches the characters that it builds.
class MeasuredValues {
 public:
  // The library must outlive it.
  MeasuredValues(const Library& library, CheckSettings settings) : library_(library), settings_(std::move(settings)) {}

  // Returns "turns 3 600 °/s, limit 733 °/s"; "" if the value does not follow from the stored margin, or if the case's
  // character has changed since.
  std::string text_of(const Case& stored);

  // Returns the same text, or else how far beyond its limit the subject is; "" for a crash, a timeout or memory.
  std::string sentence_of(const Case& stored);

 private:
  const std::optional<Character>& character_of(const Case& stored);

  const Library& library_;
  CheckSettings settings_;
  std::map<std::string, std::optional<Character>> characters_;  // by hash
};

}  // namespace contort::cli
