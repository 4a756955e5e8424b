# CPack reads this before it begins: all times in the package are that of the commit.
include(${CPACK_CONTORT_SOURCE}/cmake/source_date.cmake)
contort_source_date(${CPACK_CONTORT_SOURCE})
