// What Python keeps of a thread.
#pragma once

namespace calligraphy::python {

/// In a thread of C++, before it takes the GIL: what Python keeps of the thread is kept until the thread ends. Made
/// anew in every tick it costs some 30 us. Whoever joins such a thread must not hold the GIL.
void keep_thread_state();

}  // namespace calligraphy::python
