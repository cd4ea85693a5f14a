"""The system calls that student code may make, as a program for the kernel's filter (seccomp).

What isn't named here doesn't exist for the code: no files but to read, no processes, no sockets, no signals, no shared
memory, nothing that changes a file's owner, mode or time. The list is what Python's interpreter and NumPy need; "not
implemented" is what a C library expects of a kernel that lacks a call, and it then takes an older one.

libseccomp knows the numbers of the calls on each processor, and comes with apt, dnf and systemd. Its binding for Python
isn't on PyPI, and pyseccomp, a beta that stands in for it, has had no release since 2021; six functions need neither.
"""

import ctypes
import errno
import os
import tempfile
from functools import lru_cache

ALWAYS = """
    access arch_prctl brk capget clock_getres clock_gettime clock_nanosleep close dup dup2 dup3
    epoll_create epoll_create1 epoll_ctl epoll_pwait epoll_wait eventfd eventfd2 exit exit_group faccessat
    faccessat2 fadvise64 fstat fstat64 fstatat64 fstatfs futex futex_time64 get_robust_list getcpu getcwd getdents
    getdents64 getegid geteuid getgid getgroups getpgid getpgrp getpid getppid getpriority getrandom getresgid
    getresuid getrlimit getrusage getsid gettid gettimeofday getuid lseek _llseek lstat lstat64 madvise membarrier
    mincore mmap mmap2 mprotect mremap munmap nanosleep newfstatat pause pipe pipe2 poll ppoll pread64 preadv
    pselect6 read readlink readlinkat readv restart_syscall rseq rt_sigaction rt_sigpending rt_sigprocmask
    rt_sigreturn rt_sigsuspend rt_sigtimedwait sched_getaffinity sched_getparam sched_getscheduler sched_yield
    select set_robust_list set_tid_address sigaltstack sigreturn stat stat64 statfs statx sysinfo time times
    ugetrlimit uname wait4 waitid write writev
""".split()  # noqa: SIM905 - a line a name would be a hundred
"""Calls that read, compute, wait, or write to what is open already."""

_MASKED = 7
_ALL = 0xFFFFFFFF
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
_THREAD = 0x10000
_TERMINAL_ASKED, _CLOSED_ON_EXEC = (0x5401, 0x5413), (0x5450, 0x5451)
_BLOCKING, _LEFT_TO_READ = 0x5421, 0x541B
_DUP, _GET_CLOSING, _SET_CLOSING, _GET_FLAGS, _SET_FLAGS, _DUP_CLOSING = 0, 1, 2, 3, 4, 1030
_SET_NAME = 15

_Rule = tuple[int, int, int]
SOMETIMES: dict[str, list[_Rule]] = {
    "open": [(1, _WRITING, 0)],
    "openat": [(2, _WRITING, 0)],
    # Threads, and no processes: so there is nothing that could be left behind, nor any other program.
    "clone": [(0, _THREAD, _THREAD)],
    "prlimit64": [(0, _ALL, 0)],
    "prctl": [(0, _ALL, _SET_NAME)],
    "ioctl": [
        (1, _ALL, which) for which in (*_TERMINAL_ASKED, *_CLOSED_ON_EXEC, _BLOCKING, _LEFT_TO_READ)
    ],
    "fcntl": [
        (1, _ALL, which)
        for which in (_DUP, _GET_CLOSING, _SET_CLOSING, _GET_FLAGS, _SET_FLAGS, _DUP_CLOSING)
    ],
}
"""Call -> (argument, mask, value): allowed where the masked argument has one of the values."""

_ALLOW = 0x7FFF0000
_NOT_IMPLEMENTED = 0x00050000 | errno.ENOSYS
_OPTIMIZE, _BINARY_TREE = 8, 2


class _Comparison(ctypes.Structure):
    _fields_ = [
        ("argument", ctypes.c_uint),
        ("operator", ctypes.c_int),
        ("first", ctypes.c_uint64),
        ("second", ctypes.c_uint64),
    ]


@lru_cache(maxsize=1)
def filter_program() -> bytes:
    """The filter as the kernel takes it; empty where libseccomp isn't or can't make it."""
    try:
        library = ctypes.CDLL("libseccomp.so.2")
        library.seccomp_init.restype = ctypes.c_void_p
    except (OSError, AttributeError):
        return b""
    made = library.seccomp_init(_NOT_IMPLEMENTED)
    if not made:
        return b""
    context = ctypes.c_void_p(made)
    try:
        # Fewer comparisons for each call; versions before 2.5 know no such wish and do without.
        library.seccomp_attr_set(context, _OPTIMIZE, _BINARY_TREE)
        rules: list[tuple[str, _Rule | None]] = [(name, None) for name in ALWAYS]
        rules += [(name, rule) for name, several in SOMETIMES.items() for rule in several]
        if any(_allow(library, context, name, rule) for name, rule in rules):
            return b""
        with tempfile.TemporaryFile() as file:
            if library.seccomp_export_bpf(context, file.fileno()):
                return b""
            file.seek(0)
            return file.read()
    finally:
        library.seccomp_release(context)


def _allow(library: ctypes.CDLL, context: ctypes.c_void_p, name: str, rule: _Rule | None) -> int:
    """Add a rule; 0, or what the library says against it."""
    number = library.seccomp_syscall_resolve_name(name.encode())
    if number < 0:
        return 0  # This processor has no such call.
    if rule is None:
        return int(library.seccomp_rule_add_array(context, _ALLOW, number, 0, None))
    argument, mask, value = rule
    compared = _Comparison(argument, _MASKED, mask, value)
    return int(library.seccomp_rule_add_array(context, _ALLOW, number, 1, ctypes.byref(compared)))
