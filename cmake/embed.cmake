# Writes a C++ file that holds the texts of FILES, in the order of their names:
# embed.cmake -DOUTPUT=… -DFILES=a.json;b.json -DHEADER=path/of/the.h -DFUNCTION=stock_files
if(NOT OUTPUT OR NOT HEADER OR NOT FUNCTION)
  message(FATAL_ERROR "embed.cmake needs -DOUTPUT=…, -DFILES=…, -DHEADER=… and -DFUNCTION=…")
endif()
set(text "#include \"${HEADER}\"\n\nnamespace contort {\n\n")
string(APPEND text "std::span<const StockFile> ${FUNCTION}() {\n  static const StockFile files[] = {\n")
list(SORT FILES)
foreach(file IN LISTS FILES)
  file(READ ${file} content)
  get_filename_component(name ${file} NAME)
  # A string literal holds at most 64 KiB in the standard; our files are far below, and a bigger one fails to compile.
  string(APPEND text "      {\"${name}\", R\"json(${content})json\"},\n")
endforeach()
string(APPEND text "  };\n  return files;\n}\n\n}  // namespace contort\n")
file(WRITE ${OUTPUT} "${text}")
