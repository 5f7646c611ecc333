#include <gpu_shading_answers.h>
#include <penumbra/simulation.h>

namespace Penumbra {

namespace answers = gpu_shading::answers;

std::vector<std::string> take_options(std::vector<std::string> const& arguments) {
  return answers::take_options(arguments);
}

std::string options_help() { return answers::options_help(); }

bool is_wanted() { return answers::is_wanted(); }

std::string read_idf(std::string const& text, std::string const& path, std::string const& version) {
  return answers::read_model(text, answers::Format::idf, path, version);
}

std::string read_epjson(std::string const& text, std::string const& path,
                        std::string const& version) {
  return answers::read_model(text, answers::Format::epjson, path, version);
}

}  // namespace Penumbra
