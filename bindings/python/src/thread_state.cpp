// What Python keeps of a thread.
#include "thread_state.hpp"

#include <pybind11/pybind11.h>

namespace calligraphy::python {
namespace {

class KeptState {
 public:
  KeptState() {
    if (PyGILState_GetThisThreadState() != nullptr) return;  // a thread of Python
    lock_ = PyGILState_Ensure();
    state_ = PyEval_SaveThread();
  }
  ~KeptState() {
    if (state_ == nullptr || Py_IsInitialized() == 0) return;
    PyEval_RestoreThread(state_);
    PyGILState_Release(lock_);
  }
  KeptState(const KeptState&) = delete;
  KeptState& operator=(const KeptState&) = delete;

 private:
  PyGILState_STATE lock_ = PyGILState_UNLOCKED;
  PyThreadState* state_ = nullptr;
};

}  // namespace

void keep_thread_state() { thread_local const KeptState kept; }

}  // namespace calligraphy::python
