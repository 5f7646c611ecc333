# As a script: writes ${output}, which names the function that libgpu_shading_gl.so exports, after a
# digest of ${headers} and the ${compiler}.
set(texts "${compiler}")
foreach(header IN LISTS headers)
  file(READ ${header} text)
  string(APPEND texts "${text}")
endforeach()
string(SHA256 digest "${texts}")
string(SUBSTRING ${digest} 0 16 digest)
file(WRITE ${output} "#pragma once

#define GPU_SHADING_GL_MODULE gpu_shading_gl_module_${digest}
")
