# What `cmake --install` puts where: the library with its headers and its CMake package, the program, and the files that
# both read while they run. Everything finds the rest by its own place, so that the whole may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(TARN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tarn)
set(TARN_DATA_DIR ${CMAKE_INSTALL_DATADIR}/tarn)

install(TARGETS tarn_engine EXPORT tarnTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY engine/include/tarn DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY shaders DESTINATION ${TARN_DATA_DIR} PATTERN README.md EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/noise/blue_noise.bin DESTINATION ${TARN_DATA_DIR}/noise)
install(EXPORT tarnTargets NAMESPACE tarn:: DESTINATION ${TARN_PACKAGE_DIR})
configure_package_config_file(cmake/tarnConfig.cmake.in ${PROJECT_BINARY_DIR}/tarnConfig.cmake
                              INSTALL_DESTINATION ${TARN_PACKAGE_DIR} PATH_VARS TARN_DATA_DIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tarnConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tarnConfig.cmake ${PROJECT_BINARY_DIR}/tarnConfigVersion.cmake
        DESTINATION ${TARN_PACKAGE_DIR})

if(TARN_TOOLS)
  install(TARGETS tarn tarn-sandbox RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${PROJECT_BINARY_DIR}/content DESTINATION ${TARN_DATA_DIR} FILES_MATCHING PATTERN *.glb
          PATTERN CMakeFiles EXCLUDE)
  install(DIRECTORY content/flythroughs DESTINATION ${TARN_DATA_DIR})
  install(DIRECTORY tools/report DESTINATION ${TARN_DATA_DIR})
  install(FILES ${CHART_JS} DESTINATION ${TARN_DATA_DIR}/report/lib)
endif()
