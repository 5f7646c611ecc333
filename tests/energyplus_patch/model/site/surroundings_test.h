#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "model/idf/model_file.h"
#include "model/site/surroundings.h"
#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {

// What models read of files beside them.
class SurroundingsTest : public testing::Test {
 protected:
  void write(std::string const& name, std::string const& text) {
    std::ofstream(folder_.path() / name) << text;
  }

  Surroundings read(std::string const& text) {
    return read_surroundings(read_idf(text), folder_.path());
  }

  std::string refusal(std::string const& text) {
    return refusal_of([&] { read(text); });
  }

  TemporaryFolder folder_;
};

}  // namespace gpu_shading::energyplus
