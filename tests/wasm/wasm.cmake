# The preset wasm is built and run: minutes of compiling.
add_test(NAME Wasm.Golden
  COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/golden_test.sh ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR})
set_tests_properties(Wasm.Golden PROPERTIES TIMEOUT 1800 SKIP_RETURN_CODE 77 COST 500 LABELS slow)
add_test(NAME Wasm.Panel
  COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/panel_test.sh ${CMAKE_SOURCE_DIR} $<TARGET_FILE_DIR:contort>)
set_tests_properties(Wasm.Panel PROPERTIES TIMEOUT 1800 SKIP_RETURN_CODE 77 COST 500 LABELS slow)
set_property(TEST Wasm.Golden Wasm.Panel PROPERTY RESOURCE_LOCK wasm_build page_modules)
