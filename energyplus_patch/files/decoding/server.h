#pragma once

#include <functional>
#include <string>
#include <vector>

// A decoding program is started once and then decodes each file in a process of its own, since
// loading its libraries takes longer than decoding most files. Its standard input is a socket of
// type SOCK_SEQPACKET; standard output and error must be open. A request is a packet of words, each
// with a zero byte after it, and two descriptors: the file and where its answer goes. The reply is
// the number of the new process (32 bits), or -1 if there is none. That process is a child of the
// one that asks.
namespace gpu_shading::decoding {

inline constexpr std::size_t longest_request = 16384;  // bytes

// Serves until the other end of the socket is closed, or nothing is asked for a while. `decode`
// gets the words, with the descriptors as standard input and output, and returns the exit status.
// Returns the program's own.
int serve(std::function<int(std::vector<std::string> const&)> const& decode);

}  // namespace gpu_shading::decoding
