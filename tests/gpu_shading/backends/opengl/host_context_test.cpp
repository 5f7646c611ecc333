// A host with an OpenGL of its own finds its context as it left it.

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace gpu_shading {
namespace {

TEST(HostContext, IsCurrentAgainAfterEveryCall) {
  EGLDisplay const display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    GTEST_SKIP() << "no surfaceless platform here to play the host with";
  }
  // A host of another client API than ours.
  eglBindAPI(EGL_OPENGL_ES_API);
  EGLint const version[] = {EGL_CONTEXT_MAJOR_VERSION, 2, EGL_NONE};
  EGLContext const host = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
  ASSERT_NE(host, EGL_NO_CONTEXT);
  ASSERT_EQ(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, host), EGL_TRUE);

  auto const expect_host = [&](char const* after) {
    EXPECT_EQ(eglQueryAPI(), static_cast<EGLenum>(EGL_OPENGL_ES_API)) << after;
    EXPECT_EQ(eglGetCurrentContext(), host) << after;
  };
  {
    Scene scene;
    scene.add({"terrace", level(0, 0, 0, 4, 4)});
    scene.add({"canopy", level(-1, -1, 3, 3, 6)});
    Renderer renderer = renderer_of(scene, 512, by_opengl);
    expect_host("construction");
    EXPECT_NEAR(sunlit(renderer, {}, 0).projected_area, 8.0, 0.01);
    expect_host("projected_sunlit_areas");
    renderer.sun_view({}, 0, 64);
    expect_host("sun_view");
    SurfaceId const canopy = 1;
    renderer.interior_sunlit_areas({}, 0, {&canopy, 1});
    expect_host("interior_sunlit_areas");
  }
  expect_host("destruction");
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, host);
  eglBindAPI(EGL_OPENGL_API);
}

}  // namespace
}  // namespace gpu_shading
