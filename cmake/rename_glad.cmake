# Gives the GL loader's symbols names of Tarn's own, so that a program may have a loader of glad's beside Tarn's.
# cmake -DDIR=... -P rename_glad.cmake
foreach(FILE ${DIR}/src/gl.c ${DIR}/include/glad/gl.h)
  file(READ ${FILE} TEXT)
  foreach(NAME glad_gl GLAD_GL_ gladLoadGL)
    string(REPLACE "${NAME}" "tarn_${NAME}" TEXT "${TEXT}")
  endforeach()
  file(WRITE ${FILE} "${TEXT}")
endforeach()
