# Tests of commands that a user types: the scripts of the root, and the commands of the README and of the pages in docs.
add_test(NAME Scripts.Packages COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/packages_test.sh ${CMAKE_SOURCE_DIR})
add_test(NAME Scripts.Run COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/run_test.sh ${CMAKE_SOURCE_DIR})
add_test(NAME Scripts.Test COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/test_test.sh ${CMAKE_SOURCE_DIR})
add_test(NAME Scripts.ReadmeExtraction COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/readme_commands_test.sh)
add_test(NAME Scripts.ReadmeCommands
  COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/readme_commands.sh ${CMAKE_SOURCE_DIR} $<TARGET_FILE_DIR:contort>)
# One test for each page that has commands: Scripts.Guide.first_night, Scripts.Reference.checks and so on.
foreach(part IN ITEMS Guide Reference Internals)
  string(TOLOWER ${part} folder)
  file(GLOB pages RELATIVE ${CMAKE_SOURCE_DIR} CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/docs/${folder}/*.md)
  foreach(page IN LISTS pages)
    file(STRINGS ${CMAKE_SOURCE_DIR}/${page} blocks REGEX "^```sh$")
    if(blocks)
      get_filename_component(name ${page} NAME_WE)
      add_test(NAME Scripts.${part}.${name} COMMAND
        bash ${CMAKE_CURRENT_LIST_DIR}/readme_commands.sh ${CMAKE_SOURCE_DIR} $<TARGET_FILE_DIR:contort> ${page})
      set_tests_properties(Scripts.${part}.${name} PROPERTIES TIMEOUT 300 COST 100)
      # Their commands are those of other pages, some with runs of the fuzzer: ./test --all has the time for them.
      if(part STREQUAL "Internals")
        set_tests_properties(Scripts.${part}.${name} PROPERTIES LABELS slow)
      endif()
    endif()
  endforeach()
endforeach()
# docs/README.md lists every page, and no page is too long.
add_test(NAME Scripts.Contents COMMAND ${CMAKE_CURRENT_LIST_DIR}/contents_test.py ${CMAKE_SOURCE_DIR})
add_test(NAME Scripts.ContentsExtraction COMMAND ${CMAKE_CURRENT_LIST_DIR}/contents_test.py)
add_test(NAME Scripts.Manual COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/manual_test.sh $<TARGET_FILE:contort>)
set_tests_properties(Scripts.Manual PROPERTIES TIMEOUT 180)
add_test(NAME Scripts.CiFiles
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/ci_files_test.py ${CMAKE_SOURCE_DIR} $<TARGET_FILE:contort>)
set_tests_properties(Scripts.CiFiles PROPERTIES TIMEOUT 180 SKIP_RETURN_CODE 77 LABELS slow)
# These install what is built; one after the other, because some texts are made in the build folder.
add_test(NAME Scripts.Install
  COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/install_test.sh ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR})
add_test(NAME Scripts.Deb COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/deb_test.sh ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR})
set_tests_properties(Scripts.Install Scripts.Deb PROPERTIES TIMEOUT 300)
set_tests_properties(Scripts.Install Scripts.Deb Scripts.Guide.install PROPERTIES RESOURCE_LOCK installed_texts)
set_tests_properties(Scripts.Deb PROPERTIES SKIP_RETURN_CODE 77 LABELS slow)
add_test(NAME Scripts.LinksExtraction COMMAND ${CMAKE_CURRENT_LIST_DIR}/links_test.py)
add_test(NAME Scripts.Links COMMAND ${CMAKE_CURRENT_LIST_DIR}/links_test.py ${CMAKE_SOURCE_DIR})
set_tests_properties(Scripts.LinksExtraction Scripts.Links PROPERTIES TIMEOUT 180)
set_tests_properties(Scripts.Packages Scripts.Run Scripts.Test Scripts.ReadmeExtraction PROPERTIES TIMEOUT 180)
# COST: what takes minutes begins first, else one core waits for it at the end.
set_tests_properties(Scripts.ReadmeCommands PROPERTIES TIMEOUT 600 COST 300)
add_test(NAME Page.Browser
  COMMAND bash ${CMAKE_SOURCE_DIR}/tests/page/page_test.sh ${CMAKE_SOURCE_DIR} $<TARGET_FILE_DIR:contort>)
# A list, a case and what a stranger may have written, from the file system: what ./test has the time for.
add_test(NAME Page.Small COMMAND bash ${CMAKE_SOURCE_DIR}/tests/page/page_test.sh ${CMAKE_SOURCE_DIR}
  $<TARGET_FILE_DIR:contort> "^file: (filters show|the button opens|hostile names)|one file holds|without scripts the page is")
set_tests_properties(Page.Small PROPERTIES TIMEOUT 600 SKIP_RETURN_CODE 77 COST 400 RESOURCE_LOCK page_modules)
set_tests_properties(Page.Browser PROPERTIES RESOURCE_LOCK page_modules)
set_tests_properties(Page.Browser PROPERTIES TIMEOUT 1800 SKIP_RETURN_CODE 77 COST 1000 LABELS slow)
add_test(NAME Scripts.Mutants COMMAND ${CMAKE_SOURCE_DIR}/bench/mutants/run.py --check)
set_tests_properties(Scripts.Mutants PROPERTIES TIMEOUT 180)
add_test(NAME Scripts.Slurm
  COMMAND bash ${CMAKE_SOURCE_DIR}/tests/scale/slurm_test.sh ${CMAKE_SOURCE_DIR} $<TARGET_FILE:contort>)
set_tests_properties(Scripts.Slurm PROPERTIES TIMEOUT 900 SKIP_RETURN_CODE 77 LABELS slow)
