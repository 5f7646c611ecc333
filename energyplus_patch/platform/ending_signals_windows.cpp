#include "platform/ending_signals.h"

// Windows ends a process without asking it; the next command deletes its folders.

namespace gpu_shading::energyplus {

void clean_up_at_signals() {}
void clean_up_now() noexcept {}
void take_file_limit_as_error() {}
bool takes_file_limit_as_error() noexcept { return false; }
FolderAtSignals::FolderAtSignals(std::filesystem::path const& /*folder*/) : slot_(0) {}
void FolderAtSignals::is_made() noexcept {}
FolderAtSignals::~FolderAtSignals() = default;
ProcessAtSignals::ProcessAtSignals(int /*process*/) : slot_(0) {}
ProcessAtSignals::~ProcessAtSignals() = default;

}  // namespace gpu_shading::energyplus
