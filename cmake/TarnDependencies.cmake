# Everything from outside, each found once. The README says why each is there.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(glm CONFIG QUIET)
if(NOT TARGET glm::glm)
  find_path(GLM_INCLUDE_DIR glm/glm.hpp REQUIRED)
  add_library(glm::glm INTERFACE IMPORTED)
  target_include_directories(glm::glm INTERFACE ${GLM_INCLUDE_DIR})
endif()
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(embree 3 QUIET)
if(NOT embree_FOUND)
  find_package(embree 4 REQUIRED)
endif()
set(TARN_EMBREE_MAJOR ${embree_VERSION_MAJOR})
set_property(TARGET embree APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS TARN_EMBREE_MAJOR=${TARN_EMBREE_MAJOR})
find_package(OpenEXR REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Boost REQUIRED)
pkg_check_modules(TINYGLTF REQUIRED IMPORTED_TARGET tinygltf)
pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)

if(TARN_TOOLS)
  find_package(CLI11 REQUIRED)
  find_package(glfw3 3.3 REQUIRED)
  pkg_check_modules(BULLET REQUIRED IMPORTED_TARGET bullet)  # for the sandbox
  pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
  pkg_check_modules(OSMESA REQUIRED osmesa)  # for --context osmesa, loaded at run time
  find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui REQUIRED)
  find_library(IMGUI_LIBRARY imgui REQUIRED)
  add_library(imgui_imgui INTERFACE)
  target_include_directories(imgui_imgui SYSTEM INTERFACE ${IMGUI_INCLUDE_DIR} ${IMGUI_INCLUDE_DIR}/backends)
  target_link_libraries(imgui_imgui INTERFACE ${IMGUI_LIBRARY} PkgConfig::STB ${CMAKE_DL_LIBS})
endif()
if(TARN_TESTS)
  find_package(GTest REQUIRED)
endif()

# Imported targets are seen in this folder and below; whoever links Tarn from above needs them too.
if(NOT PROJECT_IS_TOP_LEVEL)
  get_property(IMPORTED DIRECTORY PROPERTY IMPORTED_TARGETS)
  foreach(TARGET ${IMPORTED})
    set_target_properties(${TARGET} PROPERTIES IMPORTED_GLOBAL TRUE)
  endforeach()
endif()

# The GL loader, written at build time by Debian's generator from its own copy of the registry (no network).
find_program(GLAD_GENERATOR glad REQUIRED)
set(GLAD_DIR ${PROJECT_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h
  COMMAND ${GLAD_GENERATOR} --quiet --api gl:core=4.5 --extensions GL_KHR_debug --reproducible
          --out-path ${GLAD_DIR} c
  COMMAND ${CMAKE_COMMAND} -DDIR=${GLAD_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/rename_glad.cmake
  DEPENDS ${PROJECT_SOURCE_DIR}/cmake/rename_glad.cmake
  COMMENT "Generating the OpenGL 4.5 loader"
  VERBATIM)
add_library(tarn_glad STATIC ${GLAD_DIR}/src/gl.c)
target_include_directories(tarn_glad SYSTEM PUBLIC ${GLAD_DIR}/include)
