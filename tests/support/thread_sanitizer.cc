// For ThreadSanitizer alone. Debian's abseil is built without it, so it would not see what order
// absl::Mutex and absl::Notification make, and call all that they guard a race. These stand before
// the library's functions, call them, and tell it.
#include <dlfcn.h>
#include <sanitizer/tsan_interface.h>

#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"

// A condition is looked at by whoever unlocks, for those who wait: guarded, but after the release
// below.
extern "C" const char* __tsan_default_suppressions() { return "race:CastAndCallMethod\n"; }

namespace absl {
ABSL_NAMESPACE_BEGIN
namespace {

// The library's function of that mangled name.
template <typename Result, typename... Arguments>
Result Library(const char* name, Arguments... arguments) {
  return reinterpret_cast<Result (*)(Arguments...)>(dlsym(RTLD_NEXT, name))(arguments...);
}

}  // namespace

#define LAMBERT_NAME(rest) "_ZN4absl7debian3" rest

void Mutex::Lock() {
  Library<void>(LAMBERT_NAME("5Mutex4LockEv"), this);
  __tsan_acquire(this);
}

bool Mutex::TryLock() {
  const bool is_locked = Library<bool>(LAMBERT_NAME("5Mutex7TryLockEv"), this);
  if (is_locked) __tsan_acquire(this);
  return is_locked;
}

void Mutex::Unlock() {
  __tsan_release(this);
  Library<void>(LAMBERT_NAME("5Mutex6UnlockEv"), this);
}

void Mutex::LockWhen(const Condition& condition) {
  Library<void>(LAMBERT_NAME("5Mutex8LockWhenERKNS0_9ConditionE"), this, &condition);
  __tsan_acquire(this);
}

void Mutex::Await(const Condition& condition) {
  __tsan_release(this);
  Library<void>(LAMBERT_NAME("5Mutex5AwaitERKNS0_9ConditionE"), this, &condition);
  __tsan_acquire(this);
}

bool Mutex::AwaitWithTimeout(const Condition& condition, Duration timeout) {
  __tsan_release(this);
  const bool is_true =
      Library<bool>(LAMBERT_NAME("5Mutex16AwaitWithTimeoutERKNS0_9ConditionENS0_8DurationE"), this,
                    &condition, timeout);
  __tsan_acquire(this);
  return is_true;
}

void Notification::Notify() {
  __tsan_release(this);
  Library<void>(LAMBERT_NAME("12Notification6NotifyEv"), this);
}

void Notification::WaitForNotification() const {
  Library<void>("_ZNK4absl7debian312Notification19WaitForNotificationEv", this);
  __tsan_acquire(const_cast<Notification*>(this));
}

ABSL_NAMESPACE_END
}  // namespace absl
