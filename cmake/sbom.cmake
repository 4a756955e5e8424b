# Writes which packages Contort is built from, and which of them are in its files, in the format SPDX 2.3:
# sbom.cmake -DSOURCE=folder of the project -DVERSION=0.1.0 -DOUTPUT=contort.spdx.json [-DENGINE=ON]
# ENGINE: engine.js is there, too (docs/internals/wasm.md).
# The lists are those of packages.txt (group product) and of the lock file of renders/page; versions of Debian packages
# are those of this machine. The time in it is SOURCE_DATE_EPOCH, where that is set.
cmake_minimum_required(VERSION 3.25)
string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)
include(${CMAKE_CURRENT_LIST_DIR}/compiled_in.cmake)
set(packages "")
set(relations "")

function(contort_sbom_add list text)
  if(${list})
    string(PREPEND text "${${list}},\n    ")
  endif()
  set(${list} "${text}" PARENT_SCOPE)
endfunction()

# contort_sbom_package(ID NAME VERSION LICENCE URL RELATION COMMENT): RELATION is CONTAINS or STATIC_LINK where code of
# the package is in our files, else what the package is for Contort.
function(contort_sbom_package id name version licence url relation comment)
  string(REPLACE "\\" "\\\\" comment "${comment}")
  string(REPLACE "\"" "\\\"" comment "${comment}")
  contort_sbom_add(packages "{\"SPDXID\": \"SPDXRef-${id}\", \"name\": \"${name}\", \"versionInfo\": \"${version}\", \
\"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseConcluded\": \"NOASSERTION\", \
\"licenseDeclared\": \"${licence}\", \"copyrightText\": \"NOASSERTION\", \"comment\": \"${comment}\", \
\"externalRefs\": [{\"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\", \
\"referenceLocator\": \"${url}\"}]}")
  if(relation MATCHES "^(CONTAINS|STATIC_LINK)$")
    set(from Contort)
    set(to ${id})
  else()
    set(from ${id})
    set(to Contort)
  endif()
  contort_sbom_add(relations "{\"spdxElementId\": \"SPDXRef-${from}\", \"relationshipType\": \"${relation}\", \
\"relatedSpdxElement\": \"SPDXRef-${to}\"}")
  set(packages "${packages}" PARENT_SCOPE)
  set(relations "${relations}" PARENT_SCOPE)
endfunction()

function(contort_sbom_debian name relation why)
  set(version "")
  execute_process(COMMAND dpkg-query --show "--showformat=\${Version}" ${name} OUTPUT_VARIABLE version ERROR_QUIET)
  string(MAKE_C_IDENTIFIER ${name} id)
  string(REPLACE _ - id ${id})
  if(version STREQUAL "")
    set(version NOASSERTION)
  endif()
  if(ENGINE AND name IN_LIST CONTORT_IN_ENGINE)
    set(relation STATIC_LINK)
  endif()
  contort_sbom_package(deb-${id} ${name} ${version} NOASSERTION "pkg:deb/debian/${name}" ${relation} "${why}")
  set(packages "${packages}" PARENT_SCOPE)
  set(relations "${relations}" PARENT_SCOPE)
endfunction()

file(STRINGS ${SOURCE}/packages.txt lines)
set(named "")
foreach(line IN LISTS lines)
  if(line MATCHES "^# group: (.*)$")
    set(group ${CMAKE_MATCH_1})
  elseif(group STREQUAL "product" AND line MATCHES "^([a-z0-9.+-]+) *# *(.*)$")
    set(name ${CMAKE_MATCH_1})
    set(why "${CMAKE_MATCH_2}")
    set(relation BUILD_DEPENDENCY_OF)
    if(name IN_LIST CONTORT_COMPILED_IN)
      set(relation STATIC_LINK)
    endif()
    contort_sbom_debian(${name} ${relation} "${why}")
    list(APPEND named ${name})
  endif()
endforeach()
if(ENGINE)
  list(REMOVE_ITEM CONTORT_IN_ENGINE ${named})
  foreach(name IN LISTS CONTORT_IN_ENGINE)
    contort_sbom_debian(${name} STATIC_LINK "compiles engine.js; its C and C++ libraries are in there")
  endforeach()
endif()

# Of npm's packages, those that package.json names; the others of the lock file are builds of esbuild for other machines.
file(READ ${SOURCE}/renders/page/package.json asked)
file(READ ${SOURCE}/renders/page/package-lock.json lock)
string(JSON count LENGTH ${asked} devDependencies)
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON name MEMBER ${asked} devDependencies ${i})
  foreach(field version license integrity)
    string(JSON ${field} GET ${lock} packages node_modules/${name} ${field})
  endforeach()
  set(relation BUILD_TOOL_OF)
  if(name IN_LIST CONTORT_BUNDLED)
    set(relation CONTAINS)
  endif()
  contort_sbom_package(npm-${name} ${name} ${version} ${license} "pkg:npm/${name}@${version}" ${relation}
                       "npm integrity ${integrity}")
endforeach()

file(WRITE ${OUTPUT} "{
  \"spdxVersion\": \"SPDX-2.3\",
  \"dataLicense\": \"CC0-1.0\",
  \"SPDXID\": \"SPDXRef-DOCUMENT\",
  \"name\": \"contort-${VERSION}\",
  \"documentNamespace\": \"https://example.org/spdx/contort-${VERSION}\",
  \"creationInfo\": {\"created\": \"${created}\", \"creators\": [\"Organization: The Contort developers\"]},
  \"packages\": [
    {\"SPDXID\": \"SPDXRef-Contort\", \"name\": \"contort\", \"versionInfo\": \"${VERSION}\", \
\"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseConcluded\": \"MIT\", \
\"licenseDeclared\": \"MIT\", \"copyrightText\": \"Copyright (c) 2026 The Contort developers\"},
    ${packages}
  ],
  \"relationships\": [
    {\"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\", \
\"relatedSpdxElement\": \"SPDXRef-Contort\"},
    ${relations}
  ]
}
")
