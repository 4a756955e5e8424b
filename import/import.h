// A rigged model becomes a character: the stages in order, and the files that come of it (docs/import.md).
#pragma once

#include "import/contacts.h"
#include "import/parts.h"

namespace contort {

struct ImportFile {
  std::string name;  // in the library folder
  std::string text;
};

struct Imported {
  RiggedFigure figure;
  CutFigure cut;
  OwnContacts contacts;
  double mass_kg = 0.0;
  std::vector<ImportFile> files;  // the report is the last one
};

// Codes import.*, and those of build_character, should a model be too odd for it.
Result<Imported> import_model(const SkinnedAsset& asset, const ImportOptions& options);

// A file's name to a legal one: "Knight" of "models/Knight.glb".
std::string name_of_file(const std::string& path);

// IMPORT.md's text.
std::string write_report(const Imported& imported, const std::string& name);

std::string_view source_name(LimitSource source);
int count_sources(const Imported& imported, LimitSource source);

}  // namespace contort
