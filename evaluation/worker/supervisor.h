#pragma once
/// A worker consists of two processes. The one that is started becomes the supervisor, which runs halyard's own code
/// only; its child works with what is not trusted. A process that the child starts, in whatever group or session,
/// stays below the supervisor: when its parent ends, the supervisor becomes its parent (PR_SET_CHILD_SUBREAPER).

namespace halyard {

/// Returns 0 in a new child, which leads a process group. The calling process becomes its supervisor and does not
/// return: when the child has ended, when nobody reads the pipe `answer` any more, or at SIGTERM, SIGINT or SIGHUP, it
/// kills all processes below it, and then ends as the child did. Where the kernel does not list children
/// (/proc/thread-self/children), it kills the child's group only.
/// Call before other threads start. Returns the number of the error, in the calling process, if there can be no further
/// process.
int continue_in_supervised_child(int answer);

}  // namespace halyard
