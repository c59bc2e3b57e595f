# SPDX-License-Identifier: MIT
# cmake --install: the program, the library with its public headers, and a CMake package.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/ltcfit)

install(TARGETS ltcfit RUNTIME)
install(TARGETS ltcfit_library EXPORT ltcfit-targets ARCHIVE)
install(DIRECTORY include/ltcfit DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT ltcfit-targets NAMESPACE ltcfit:: DESTINATION ${package_folder})

configure_package_config_file(cmake/ltcfit-config.cmake.in
  ${PROJECT_BINARY_DIR}/generated/ltcfit-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/ltcfit-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES cmake/ltcfit-dependencies.cmake
  ${PROJECT_BINARY_DIR}/generated/ltcfit-config.cmake
  ${PROJECT_BINARY_DIR}/generated/ltcfit-config-version.cmake DESTINATION ${package_folder})
