# SPDX-License-Identifier: MIT
# cmake --install: the program with its manual and completions, the library with its public headers, and a CMake package.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/ltcfit)

install(TARGETS ltcfit RUNTIME)
# What the program prints of itself for manuals and shells.
function(install_print folder file)
  set(made ${PROJECT_BINARY_DIR}/install/${file})
  install(CODE "file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/install)
execute_process(COMMAND $<TARGET_FILE:ltcfit> ${ARGN} OUTPUT_FILE ${made} COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${made} DESTINATION ${folder})
endfunction()
install_print(${CMAKE_INSTALL_MANDIR}/man1 ltcfit.1 man)
install_print(${CMAKE_INSTALL_DATADIR}/bash-completion/completions ltcfit completion bash)
install_print(${CMAKE_INSTALL_DATADIR}/zsh/site-functions _ltcfit completion zsh)
install_print(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d ltcfit.fish completion fish)
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
