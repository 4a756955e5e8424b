# CPack runs this on the installed files before it packs them: adds what Debian asks of a package, and sets all times to
# that of the commit.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share)
set(doc ${share}/doc/contort)
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

file(READ ${CPACK_CONTORT_SOURCE}/LICENSE licence)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)\n+(.*)" found "${licence}")
set(owner "${CMAKE_MATCH_1}")
string(STRIP "${CMAKE_MATCH_2}" terms)
string(REGEX REPLACE "\n\n" "\n.\n" terms "${terms}")
string(REPLACE "\n" "\n " terms "${terms}")
file(WRITE ${doc}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: contort

Files: *
Copyright: ${owner}
License: Expat
")
if(EXISTS ${share}/contort/page/viewer.js)
  file(APPEND ${doc}/copyright "
Files: usr/share/contort/page/*
Copyright: ${owner}
 2010-2026 three.js authors
 2022 Leon Sorokin (uPlot)
License: Expat
")
endif()
file(APPEND ${doc}/copyright "Comment: licences has the texts of the libraries whose headers are compiled in,
 or which are linked statically.
")
if(EXISTS ${share}/contort/page/engine.js)
  file(APPEND ${doc}/copyright "
Files: usr/share/contort/page/engine.js
Copyright: ${owner}
 2010-2022 The Emscripten Authors
 2005-2015 G-Truc Creation (GLM)
 2015-2022 Syoyo Fujita and Aurelien Chatelain (tinygltf)
 2012-2014 Yann Collet (xxHash)
 2013-2022 Niels Lohmann (nlohmann-json)
License: Expat and others
 All code of Contort in it has the licence below. The end of the file itself and
 the folder licences have the texts for the libraries that are compiled in.
")
endif()
file(APPEND ${doc}/copyright "
License: Expat
 ${terms}
")

execute_process(COMMAND date --utc --rfc-email --date=@$ENV{SOURCE_DATE_EPOCH} OUTPUT_VARIABLE date
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${doc}/changelog.Debian "contort (${version}) unstable; urgency=medium

  * The package of this version; changelog.gz has what changed in Contort.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
file(RENAME ${doc}/CHANGELOG.md ${doc}/changelog)
execute_process(COMMAND gzip -9nf ${doc}/changelog.Debian ${doc}/changelog COMMAND_ERROR_IS_FATAL ANY)

execute_process(COMMAND find ${CPACK_TEMPORARY_INSTALL_DIRECTORY} -exec touch --no-dereference
                        --date=@$ENV{SOURCE_DATE_EPOCH} {} + COMMAND_ERROR_IS_FATAL ANY)
