// SPDX-License-Identifier: BSD-3-Clause
// A library to preload into a program: lets one of its calls of the system fail, the FAILING_NUMBER-th of those that
// FAILING_CALL names (open, read or write), with the error FAILING_ERROR, a number. FAILING_COUNT is a file of
// eight zeros, in which they are counted. Only calls of the program FAILING_PROGRAM count, not those of its children.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// The number of calls so far, in a file: some programs end without destroying anything.
std::atomic<long>* shared_count() {
  const int file = static_cast<int>(syscall(SYS_openat, AT_FDCWD, setting("FAILING_COUNT"), O_RDWR | O_CLOEXEC));
  void* memory = mmap(nullptr, sizeof(long), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  syscall(SYS_close, file);
  if (memory == MAP_FAILED) std::abort();
  return static_cast<std::atomic<long>*>(memory);
}

/// Counts the calls of one kind.
class Failure {
 public:
  Failure()
      : calls_(std::strcmp(program_invocation_short_name, setting("FAILING_PROGRAM")) == 0 ? shared_count() : nullptr),
        number_(std::atol(setting("FAILING_NUMBER"))),
        error_(std::atoi(setting("FAILING_ERROR"))) {}

  /// Whether this call fails; then errno is set.
  bool takes(const char* kind) {
    if (calls_ == nullptr || std::strcmp(kind, setting("FAILING_CALL")) != 0 || ++*calls_ != number_) return false;
    errno = error_;
    return true;
  }

 private:
  std::atomic<long>* const calls_;  // null in other programs
  const long number_;
  const int error_;
};

Failure& failure() {
  static Failure one;
  return one;
}

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

mode_t mode_of(int flags, std::va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" {

ssize_t read(int descriptor, void* to, std::size_t size) {
  static auto* const call = original<ssize_t(int, void*, std::size_t)>("read");
  return failure().takes("read") ? -1 : call(descriptor, to, size);
}

ssize_t write(int descriptor, const void* from, std::size_t size) {
  static auto* const call = original<ssize_t(int, const void*, std::size_t)>("write");
  return failure().takes("write") ? -1 : call(descriptor, from, size);
}

ssize_t writev(int descriptor, const iovec* from, int count) {
  static auto* const call = original<ssize_t(int, const iovec*, int)>("writev");
  return failure().takes("write") ? -1 : call(descriptor, from, count);
}

int open(const char* path, int flags, ...) {
  static auto* const call = original<int(const char*, int, mode_t)>("open");
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return failure().takes("open") ? -1 : call(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  static auto* const call = original<int(const char*, int, mode_t)>("open64");
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return failure().takes("open") ? -1 : call(path, flags, mode);
}

std::FILE* fopen(const char* path, const char* mode) {
  static auto* const call = original<std::FILE*(const char*, const char*)>("fopen");
  return failure().takes("open") ? nullptr : call(path, mode);
}

std::FILE* fopen64(const char* path, const char* mode) {
  static auto* const call = original<std::FILE*(const char*, const char*)>("fopen64");
  return failure().takes("open") ? nullptr : call(path, mode);
}

}  // extern "C"
