// Makes a character from a rigged model: the stages in order, and the files that they write (docs/reference/import.md).
#pragma once

#include "import/contacts.h"
#include "import/parts.h"

namespace contort {

struct ImportFile {
  std::string name;  // path in the library folder
  std::string text;
};

struct Imported {
  RiggedFigure figure;
  CutFigure cut;
  OwnContacts contacts;
  double mass_kg = 0.0;
  std::vector<ImportFile> files;  // the report is the last one
};

// Codes import.*, and those of build_character if the model gives no valid character.
Result<Imported> import_model(const SkinnedAsset& asset, const ImportOptions& options);

// Refuses a name that a character cannot have, or that is a stock character's. Code import.bad_name.
Result<Done> check_import_name(const std::string& name);

// Makes a valid name from a file's path, such as "Knight" from "models/Knight.glb".
std::string name_of_file(const std::string& path);

// Returns the text of the report, NAME.import.md.
std::string write_report(const Imported& imported, const std::string& name);

std::string_view source_name(LimitSource source);
int count_sources(const Imported& imported, LimitSource source);

// The number of joints with a range from the table of people that the model's own clips leave.
int count_too_narrow(const Imported& imported);

}  // namespace contort
