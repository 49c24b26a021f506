# tarn_version: the version, and the commit as of the build. Its source is written anew only when HEAD has moved. Sources
# without a repository of their own, such as an archive, say "unknown".
set(VERSION_CPP ${PROJECT_BINARY_DIR}/generated/version.cpp)
set(GIT_TOP "")
find_package(Git QUIET)
if(GIT_FOUND)
  # In a container the checkout often belongs to another user, which git refuses by itself.
  set(GIT ${GIT_EXECUTABLE} -c safe.directory=*)
  execute_process(COMMAND ${GIT} rev-parse --show-toplevel WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE GIT_TOP OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT} rev-parse --git-path logs/HEAD WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE HEAD_LOG OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
set(HEAD_FILE "")
if(GIT_TOP STREQUAL PROJECT_SOURCE_DIR)
  get_filename_component(HEAD_LOG ${HEAD_LOG} ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
  if(EXISTS ${HEAD_LOG})  # git adds a line whenever HEAD moves
    set(HEAD_FILE ${HEAD_LOG})
  endif()
else()
  set(GIT "")
endif()
add_custom_command(
  OUTPUT ${VERSION_CPP}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${VERSION_CPP} -DVERSION=${PROJECT_VERSION} -DBUILD_TYPE=$<CONFIG> "-DGIT=${GIT}"
          -DSOURCE=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  DEPENDS ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake ${HEAD_FILE}
  COMMENT "Noting the version"
  VERBATIM)
add_library(tarn_version STATIC ${VERSION_CPP})
target_compile_features(tarn_version PUBLIC cxx_std_20)
target_include_directories(tarn_version PUBLIC ${PROJECT_SOURCE_DIR}/engine)
