# `cpack` in a build folder makes contort_VERSION_ARCH.deb. The same commit gives the same bytes (cmake/cpack_start.cmake).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME contort)
set(CPACK_PACKAGE_CONTACT "The Contort developers <contort@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "QA and fuzzing harness for procedural character animation")
set(CPACK_PACKAGE_DESCRIPTION
"Contort composes random requests to an animation generator, checks every
frame of the motions (joint ranges, speeds, collisions, foot sliding, balance
and more), makes each failing request as small as it can be, stores it, and
draws it without a screen or a GPU.")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
# Debian itself would begin with -1; a package from elsewhere must be older than that.
set(CPACK_DEBIAN_PACKAGE_RELEASE 0contort1)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded at run time: who draws, and the font of the text in pictures. Without them reports have no pictures.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-dejavu-core, libosmesa6 | libegl-mesa0")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3, nodejs")
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/cmake/cpack_start.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/deb_files.cmake)
set(CPACK_CONTORT_SOURCE ${CMAKE_SOURCE_DIR})
include(CPack)
