// In place of two libraries that static libtiff and libgeotiff are linked with, and of which
// readers of images need nothing: JBIG-KIT, without which a TIFF with JBIG's compression is not
// read, and PROJ, which names and converts coordinate systems. The names and arguments are those of
// these libraries.

#include <cstddef>

namespace {

constexpr int failed = 1;

}  // namespace

extern "C" {

void jbg_dec_init(void* /*state*/) {}
int jbg_dec_in(void* /*state*/, unsigned char* /*data*/, std::size_t /*size*/,
               std::size_t* /*used*/) {
  return failed;
}
unsigned long jbg_dec_getsize(void const* /*state*/) { return 0; }
unsigned char* jbg_dec_getimage(void const* /*state*/, int /*plane*/) { return nullptr; }
void jbg_dec_free(void* /*state*/) {}
int jbg_newlen(unsigned char* /*data*/, std::size_t /*size*/) { return failed; }
char const* jbg_strerror(int /*error*/) { return "JBIG compression is not supported"; }

void jbg_enc_init(void* /*state*/, unsigned long /*width*/, unsigned long /*height*/,
                  int /*planes*/, unsigned char** /*data*/, void* /*write*/, void* /*to*/) {}
void jbg_enc_out(void* /*state*/) {}
void jbg_enc_free(void* /*state*/) {}

void* proj_context_create() { return nullptr; }
void* proj_context_destroy(void* /*context*/) { return nullptr; }
void* proj_create_from_database(void* /*context*/, char const* /*authority*/, char const* /*code*/,
                                int /*category*/, int /*alternatives*/,
                                char const* const* /*options*/) {
  return nullptr;
}
void* proj_destroy(void* /*object*/) { return nullptr; }
char const* proj_get_name(void const* /*object*/) { return nullptr; }
int proj_uom_get_info_from_database(void* /*context*/, char const* /*authority*/,
                                    char const* /*code*/, char const** /*name*/, double* /*factor*/,
                                    char const** /*category*/) {
  return 0;
}
}
