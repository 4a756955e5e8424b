# Bundles the report's viewer and the server's pages: viewer.cmake -DNPM=npm -DFROM=renders/page -DTO=…/page
# Their packages are those of the lock file, in a folder beside TO. A failure is a warning: all but these pages works.
set(modules ${TO}_modules)
file(MAKE_DIRECTORY ${modules} ${TO})
foreach(file package.json package-lock.json)
  configure_file(${FROM}/${file} ${modules}/${file} COPYONLY)
endforeach()
execute_process(COMMAND ${NPM} ci --include=dev --ignore-scripts --no-audit --no-fund WORKING_DIRECTORY ${modules}
                RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(code EQUAL 0)
  execute_process(COMMAND node ${FROM}/build.mjs --modules ${modules}/node_modules ${TO}
                  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
endif()
if(NOT code EQUAL 0)
  foreach(file viewer.js viewer.css play.html play.js play.css live.js live.css)
    file(REMOVE ${TO}/${file})
  endforeach()
  message(WARNING "reports will have no viewer, and the server no pages:\n${output}")
endif()
