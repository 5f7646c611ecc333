#include <cxxabi.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {
namespace {

std::string demangled(char const* name) {
  std::unique_ptr<char, decltype(&std::free)> const text(
      abi::__cxa_demangle(name, nullptr, nullptr, nullptr), &std::free);
  return text == nullptr ? "" : text.get();
}

// The list of parameters, from the parenthesis that ends the declaration's.
std::string parameters(std::string const& declaration) {
  auto at = declaration.rfind(')');
  auto const end = at;
  for (int depth = 1; depth > 0;) {
    --at;
    depth += declaration[at] == ')' ? 1 : declaration[at] == '(' ? -1 : 0;
  }
  return declaration.substr(at + 1, end - at - 1);
}

// Our signature's as the compiler has it: the object of a member function comes first in it.
std::string our_parameters(std::string const& signature) {
  static std::regex const object(R"(^(?:void|gpu_shading::energyplus::\w+( const)?)\*(?:, )?)");
  return std::regex_replace(parameters(signature), object, "");
}

// EnergyPlus's types in the words of ours.
std::string their_parameters(std::string const& declaration) {
  auto list = parameters(declaration);
  for (auto const& [theirs, ours] : std::vector<std::pair<char const*, char const*>>{
           {R"(ObjexxFCL::Vector3<double>)", "gpu_shading::energyplus::Vector"},
           {R"(EnergyPlus::Dayltg::Illums)", "gpu_shading::energyplus::Illuminance"},
           {R"(Penumbra::Surface\b)", "gpu_shading::energyplus::SurfaceObject"},
           {R"(EnergyPlus::Dayltg::(SkyType|RadType))", "int"},
           {R"(EnergyPlus::Constant::(Units|eResource))", "int"},
           {R"(EnergyPlus::OutputProcessor::(TimeStepType|StoreType|Group|EndUseCat))", "int"},
           {R"(EnergyPlus::OutputProcessor::ReportFreq)", "int"}}) {
    list = std::regex_replace(list, std::regex(theirs), ours);
  }
  return list;
}

TEST(EnergyPlusSymbols, SignaturesAreThoseOfTheMangledNames) {
  auto const expect_same = [](char const* symbol, std::type_info const& signature) {
    if (!std::string_view(symbol).starts_with("_Z")) return;  // a function of the C API
    EXPECT_EQ(our_parameters(demangled(signature.name())), their_parameters(demangled(symbol)))
        << demangled(symbol);
  };
#define FUNCTION(need, name, signature, symbol) expect_same(symbol, typeid(signature));
#define CLASS(need, name, symbol) \
  EXPECT_TRUE(demangled(symbol).starts_with("vtable for ")) << demangled(symbol);
#include "routes/patched/symbols/energyplus_symbols.inc"
#undef FUNCTION
#undef CLASS
}

TEST(EnergyPlusSymbols, EachIsNamedOnce) {
  std::set<std::string_view> names;
  for (auto const name : energyplus_symbol_names()) EXPECT_TRUE(names.insert(name).second) << name;
}

}  // namespace
}  // namespace gpu_shading::energyplus
