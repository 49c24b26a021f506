# One small library per folder: it links what it may use; third-party libraries are PRIVATE to the one that hides them.

# tarn_library(NAME [PUBLIC libs...] [PRIVATE libs...]): a static library of all .cpp files of this folder.
# Includes are written from the layers' root: "core/error.h", "shared/math/brdf.h".
function(tarn_library NAME)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(tarn_${NAME} STATIC ${SOURCES})
  target_compile_features(tarn_${NAME} PUBLIC cxx_std_20)
  target_include_directories(tarn_${NAME} PUBLIC ${PROJECT_SOURCE_DIR}/engine ${PROJECT_SOURCE_DIR}/shaders)
  target_link_libraries(tarn_${NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()
