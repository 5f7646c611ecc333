// Misuse of OpenGL is an error of the tests: their contexts log it.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "backends/opengl/egl/device.h"
#include "backends/opengl/gl/check.h"
#include "support/refusal.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

TEST(DebugMessages, OfAnErrorSayWhatIsWrong) {
  auto const device = egl::open(by_opengl);
  ASSERT_TRUE(device);
  egl::Current const current = device->context.make_current();
  EXPECT_EQ(refusal_of([] { gl::check("doing nothing"); }), "accepted");
  // In the driver's own words.
  glEnable(GL_TEXTURE_3D);  // not in a core profile
  std::string const message = refusal_of([] { gl::check("provoking an error"); });
  EXPECT_NE(message.find("GL_INVALID_ENUM (0x0500) while provoking an error: "), std::string::npos)
      << message;
  EXPECT_NE(message.find("nable", message.find(": ")), std::string::npos) << message;
  EXPECT_EQ(refusal_of([] { gl::check("doing nothing"); }), "accepted");
}

// Which leaves no GL error.
TEST(DebugMessages, OfUndefinedBehaviourAreErrors) {
  auto const device = egl::open(by_opengl);
  ASSERT_TRUE(device);
  egl::Current const current = device->context.make_current();
  glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 1,
                       GL_DEBUG_SEVERITY_MEDIUM, -1, "slow");
  EXPECT_EQ(refusal_of([] { gl::check("being slow"); }), "accepted");
  glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, 2,
                       GL_DEBUG_SEVERITY_HIGH, -1, "reads what nobody wrote");
  EXPECT_EQ(refusal_of([] { gl::check("reading"); }),
            "OpenGL misused while reading: reads what nobody wrote; this is a bug in gpu_shading");
}

TEST(DebugMessages, AreNotLoggedInOrdinaryContexts) {
  auto const device = egl::open({numbered_device(0)});
  ASSERT_TRUE(device);
  egl::Current const current = device->context.make_current();
  glEnable(GL_TEXTURE_3D);
  EXPECT_EQ(refusal_of([] { gl::check("provoking an error"); }),
            "GL_INVALID_ENUM (0x0500) while provoking an error; this is a bug in gpu_shading");
}

}  // namespace
}  // namespace gpu_shading
