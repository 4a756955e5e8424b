# Sets the environment variable SOURCE_DATE_EPOCH to the time of the commit in FROM, unless the caller has set it: files
# that are made of the same commit then have the same bytes. Outside of a repository it is the time of CHANGELOG.md.
function(contort_source_date from)
  if(DEFINED ENV{SOURCE_DATE_EPOCH})
    return()
  endif()
  execute_process(COMMAND git -C ${from} log -1 --format=%ct OUTPUT_VARIABLE seconds RESULT_VARIABLE code ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT code EQUAL 0 OR seconds STREQUAL "")
    file(TIMESTAMP ${from}/CHANGELOG.md seconds "%s" UTC)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${seconds})
endfunction()
