# ruff: noqa: E501 - programs in a line
"""Attacks that reach for something outside the worker: files, processes, the network, the kernel.

Each is the body of a function of the submission; those of one worker are called one after the other. It gains if what it returns holds the token of a file that it must not
read, or begins with DONE: that it has done what it must not. Apart from that, the stage is looked at afterwards.
"""

MANY_THREADS = "more threads than a worker may have"
OLD_CALLS = "old calls of 32 bits"

PRELUDE = '''
import ctypes, gc, glob, json, os, socket, struct, sys, threading, time
import numpy as np

STAGE = json.loads({stage!r})
libc = ctypes.CDLL(None, use_errno=True)

def call(number, *arguments):
    given = [ctypes.c_long(a) if isinstance(a, int) else a for a in arguments]
    result = libc.syscall(ctypes.c_long(number), *given)
    if result < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return result

def everywhere(act):
    """Try it with all paths; what came of those that let it."""
    found = []
    for path in STAGE["secrets"]:
        try:
            found.append(act(path))
        except Exception:
            pass
    return found

def in_folders(act):
    done = []
    for folder in STAGE["folders"]:
        try:
            act(f"{{folder}}/forged-{{STAGE['mark']}}")
            done.append(folder)
        except Exception:
            pass
    return f"DONE {{done}}" if done else "refused"

def processes():
    """Of processes that can be seen, and of some that can't; neither this one nor its own."""
    seen = [int(name) for name in os.listdir("/proc") if name.isdigit()] if os.path.isdir("/proc") else []
    return [p for p in (STAGE["victim"], STAGE["grader"], *seen) if p not in (os.getpid(), os.getppid(), 1)]

def of_others(act):
    """Try it with all processes; the first that lets it."""
    for number in processes():
        try:
            found = act(number)
            if found:
                return found
        except Exception:
            pass
    return "refused"

def inside():
    """Whether bubblewrap shows a file system of its own."""
    return os.path.exists("/worker")

def writable(path):
    try:
        os.close(os.open(path, os.O_WRONLY))
        return True
    except OSError:
        return False

def descriptors():
    found = set()
    for number in range(64):
        try:
            os.fstat(number)
            found.add(number)
        except OSError:
            pass
    return found

ATTACKS = []

def run(number):
    before = descriptors()
    try:
        found = ATTACKS[number]()
    except BaseException as error:
        found = f"refused: {{type(error).__name__}} {{error}}"
    # The next one may open as many.
    gc.collect()
    for opened in descriptors() - before:
        os.close(opened)
    return np.frombuffer(str(found).encode("utf-8", "replace")[:200000] or b" ", np.uint8).copy()
'''
"""What stands before all; ``stage`` is put in."""

READING = {
    "opens the solutions": "return everywhere(lambda p: open(p).read())",
    "opens by os.open": "return everywhere(lambda p: os.read(os.open(p, os.O_RDONLY), 9999))",
    "opens through ctypes": """
        def act(p):
            fd = libc.open(p.encode(), 0)
            return os.read(fd, 9999)
        return everywhere(act)""",
    "openat2": """
        def act(p):
            how = (ctypes.c_uint64 * 3)(0, 0, 0)
            return os.read(call(437, -100, p.encode(), how, 24), 9999)
        return everywhere(act)""",
    "readline opens unaudited": """
        import readline
        def act(p):
            readline.clear_history()
            readline.read_history_file(p)
            return [readline.get_history_item(i) for i in range(20)]
        return everywhere(act)""",
    "SQLite opens": """
        import sqlite3
        def act(p):
            try:
                sqlite3.connect(p).execute("select * from sqlite_master")
            except sqlite3.DatabaseError as error:
                return "DONE" if "not a database" in str(error) else 1 / 0
        return everywhere(act) and "DONE" """,
    "memory map": """
        import mmap
        def act(p):
            with open(p, "rb") as f:
                return mmap.mmap(f.fileno(), 0, prot=mmap.PROT_READ)[:]
        return everywhere(act)""",
    "np.fromfile and np.memmap": """
        return everywhere(lambda p: np.fromfile(p, np.uint8).tobytes() + bytes(np.memmap(p, mode="r")))""",
    "linecache": "import linecache\nreturn everywhere(lambda p: linecache.getlines(p))",
    "imports by path": """
        from importlib.machinery import SourceFileLoader
        return everywhere(lambda p: SourceFileLoader("stolen", p).load_module().TOKEN)""",
    "imports the course and its solutions": """
        sys.path[:0] = [STAGE["project"]]
        found = []
        for name in ("solutions.motion_blur", "course.school.grading.references"):
            try:
                found.append(__import__(name).__file__)
            except Exception:
                pass
        return f"DONE {found}" if found else "refused" """,
    "subinterpreter without hook": """
        try:
            import _xxsubinterpreters as sub
        except ImportError:
            import _interpreters as sub
        read, write = os.pipe()
        code = f"import os\\nfor p in {STAGE['secrets']!r}:\\n try: os.write({write}, open(p,'rb').read())\\n except OSError: pass"
        sub.run_string(sub.create(), code)
        os.write(write, b".")
        return os.read(read, 99999)""",
    "takes the hook's list away": """
        import __main__
        __main__._FORBIDDEN, __main__._NO_IMPORT = (), set()
        return everywhere(lambda p: open(p).read())""",
    "lists folders": "return [os.listdir(p) for p in STAGE['secret_folders']] and 'DONE'",
    "globs": "return [f for p in STAGE['secret_folders'] for f in glob.glob(p + '/**', recursive=True) if f.endswith('.txt')] and 'DONE'",
    "an opened folder and ..": """
        found = []
        for start in (*sys.path, "/proc/self/cwd", "/proc/self/root"):
            for p in STAGE["secrets"]:
                try:
                    d = os.open(start, os.O_RDONLY)
                    found.append(os.read(os.open("../" * 12 + p.lstrip("/"), os.O_RDONLY, dir_fd=d), 9999))
                except OSError:
                    pass
        return found""",
    "through /proc/PID/root and cwd": """
        return [open(f"/proc/{n}/{way}{p}").read() for n in processes() for way in ("root", "cwd")
                for p in STAGE["secrets"] if os.access(f"/proc/{n}/{way}{p}", os.R_OK)]""",
    "a symbolic link to it": """
        def act(p):
            link = f"{STAGE['open']}/forged-{STAGE['mark']}"
            os.symlink(p, link)
            return open(link).read()
        return everywhere(act)""",
    "a hard link to it": """
        def act(p):
            link = f"{STAGE['open']}/forged-{STAGE['mark']}"
            os.link(p, link)
            return open(link).read()
        return everywhere(act)""",
    "open by handle": """
        def act(p):
            handle = (ctypes.c_uint8 * 136)(); struct.pack_into("I", handle, 0, 128)
            mount = ctypes.c_int()
            call(303, -100, p.encode(), handle, ctypes.byref(mount), 0)
            d = os.open("/", os.O_RDONLY)
            return os.read(call(304, d, handle, 0), 9999)
        return everywhere(act)""",
    "inherited descriptors": """
        found = []
        for fd in range(3, 256):
            try:
                if os.path.isfile(f"/proc/self/fd/{fd}") or os.path.isdir(f"/proc/self/fd/{fd}"):
                    found.append(f"DONE {os.readlink(f'/proc/self/fd/{fd}')}")
            except OSError:
                pass
        return found[0] if found else "none" """,
    "sends itself the file": """
        def act(p):
            read, write = os.pipe()
            os.sendfile(write, os.open(p, os.O_RDONLY), 0, 999)
            return os.read(read, 9999)
        return everywhere(act)""",
    "io_uring": """
        parameters = (ctypes.c_uint8 * 120)()
        return f"DONE {call(425, 8, parameters)}" if not inside() else "reads no more than others" """,
    "its environment": "return [f'DONE {k}' for k in os.environ if 'SECRET' in k or 'TOKEN' in k][0]",
    "environments of others": "return of_others(lambda n: open(f'/proc/{n}/environ').read())",
    "command lines of others": "return of_others(lambda n: open(f'/proc/{n}/cmdline').read())",
    "descriptors of others": "return of_others(lambda n: f'DONE {os.readlink(glob.glob(f\"/proc/{n}/fd/*\")[0])}')",
    "memory of others": """
        def act(n):
            a = int(open(f"/proc/{n}/maps").readline().split("-")[0], 16)
            with open(f"/proc/{n}/mem", "rb") as f:
                f.seek(a)
                return f"DONE {f.read(16)}"
        return of_others(act)""",
    "process_vm_readv": """
        local = ctypes.create_string_buffer(16)
        iov = (ctypes.c_uint64 * 2)(ctypes.addressof(local), 16)
        for n in processes():
            ctypes.set_errno(0)
            try:
                call(310, n, iov, 1, (ctypes.c_uint64 * 2)(0x400000, 16), 1, 0)
                return "DONE"
            except OSError as error:
                if error.errno == 14:
                    return "DONE: only the address was wrong"
        return "refused" """,
    "pidfd_getfd": """
        for n in processes():
            try:
                pid = call(434, n, 0)
                return f"DONE {call(438, pid, 0, 0)}"
            except OSError:
                pass
        return "refused" """,
    "watches folders with inotify": """
        watch = libc.inotify_init()
        done = [p for p in STAGE["secret_folders"] if libc.inotify_add_watch(watch, p.encode(), 0xfff) >= 0]
        return "DONE" if done else "refused" """,
}

WRITING = {
    "writes everywhere": "return in_folders(lambda p: open(p, 'w').write('x'))",
    "empty files": "return in_folders(lambda p: os.close(os.open(p, os.O_CREAT | os.O_WRONLY)))",
    "makes folders": "return in_folders(os.mkdir)",
    "named pipes and devices": "return in_folders(os.mkfifo)",
    "device nodes": "return in_folders(lambda p: os.mknod(p, 0o600 | 0o020000, os.makedev(1, 3)))",
    "symbolic links": "return in_folders(lambda p: os.symlink('/', p))",
    "temporary files without a name": "return in_folders(lambda p: os.open(os.path.dirname(p), os.O_TMPFILE | os.O_RDWR))",
    "a huge file": """
        def act(p):
            with open(p, "wb") as f:
                f.truncate(1 << 40)
        return in_folders(act)""",
    "a file of many bytes": """
        def act(p):
            fd = os.open(p, os.O_CREAT | os.O_WRONLY)
            os.posix_fallocate(fd, 0, 1 << 20)
        return in_folders(act)""",
    "through ctypes": "return in_folders(lambda p: 1 / (libc.open(p.encode(), 0o101, 0o600) >= 0))",
    "creat": "return in_folders(lambda p: call(85, p.encode(), 0o600))",
    "readline writes unaudited": "import readline\nreturn in_folders(readline.write_history_file)",
    "SQLite writes": """
        import sqlite3
        return in_folders(lambda p: sqlite3.connect(p).execute("create table t (a)"))""",
    "np.save": "return in_folders(lambda p: np.ones(3).tofile(p))",
    "overwrites": "return everywhere(lambda p: open(p, 'r+').write('x')) and 'DONE'",
    "empties": "return everywhere(lambda p: open(p, 'w').close()) and 'DONE'",
    "truncate": "return everywhere(lambda p: 1 / (libc.truncate(p.encode(), 0) == 0)) and 'DONE'",
    "appends": "return everywhere(lambda p: open(p, 'a').write('x')) and 'DONE'",
    "deletes": "return everywhere(os.unlink) and 'DONE'",
    "renames": "return everywhere(lambda p: os.rename(p, p + '.gone')) and 'DONE'",
    "takes folders away": """
        import shutil
        return everywhere(lambda p: os.rename(os.path.dirname(p), os.path.dirname(p) + "-gone")) and "DONE" """,
    "changes modes": "return everywhere(lambda p: os.chmod(p, 0o666)) and 'DONE'",
    "changes owners": "return everywhere(lambda p: os.chown(p, os.getuid(), os.getgid())) and 'DONE'",
    "changes times": "return everywhere(lambda p: os.utime(p, (0, 0))) and 'DONE'",
    "extended attributes": "return everywhere(lambda p: os.setxattr(p, 'user.forged', b'x')) and 'DONE'",
    "locks": """
        import fcntl
        return everywhere(lambda p: fcntl.flock(os.open(p, os.O_RDONLY), fcntl.LOCK_EX | fcntl.LOCK_NB)) and "DONE" """,
    "the grader's own files": """
        done = []
        for p in STAGE["ours"]:
            try:
                os.close(os.open(p, os.O_WRONLY | os.O_APPEND))
                done.append(p)
            except OSError:
                pass
        return f"DONE {done}" if done else "refused" """,
    "bytecode of the grader's files": """
        return in_folders(lambda p: open(os.path.dirname(p) + "/__pycache__/forged.pyc", "wb"))""",
    "remounts what is read-only": """
        done = []
        for p in ("/", "/proc", "/dev", "/worker", *STAGE["ours"], "/worker/framing.py", "/worker/program.py"):
            if libc.mount(None, p.encode(), None, 0x20 | 0x1000, None) == 0:
                done.append(p)
        return f"DONE {done}" if done else "refused" """,
    "mounts its own": "return 'DONE' if libc.mount(b'none', b'/proc', b'tmpfs', 0, None) == 0 else 'refused'",
    "mounts by the new calls": "return f'DONE {call(430, b\"tmpfs\", 0)}'",
    "moves mounts": "return f'DONE {call(428, -100, b\"/\", 1)}'",
    "unmounts": "return 'DONE' if libc.umount2(b'/proc', 2) == 0 else 'refused'",
    "chroot": "os.chroot('/')\nreturn 'DONE'",
    "pivot_root": 'return f\'DONE {call(155, b"/", b"/")}\'',
    "settings of the kernel": """
        done = [p for p in ("/proc/sys/kernel/core_pattern", "/proc/sysrq-trigger", "/proc/sys/vm/drop_caches",
                            "/sys/kernel/uevent_helper", "/proc/sys/kernel/hostname") if writable(p)]
        return f"DONE {done}" if done else "refused" """,
    "devices": """
        done = []
        for p in glob.glob("/dev/*") + ["/dev/mem", "/dev/vda", "/dev/sda"]:
            if os.path.basename(p) in ("null", "zero", "full", "random", "urandom", "tty", "ptmx", "console", "stdin", "stdout", "stderr", "fd", "shm", "pts", "core"):
                continue
            try:
                done.append(os.open(p, os.O_RDWR))
            except OSError:
                pass
        return "DONE" if done else "refused" """,
    "cgroups": "return 'DONE' if [open(p, 'w') for p in glob.glob('/sys/fs/cgroup/**/cgroup.procs', recursive=True)] else 'none'",
    "System V shared memory": "return f'DONE {call(29, 0x7061, 4096, 0o1600)}' if not inside() else 'ends with it'",
    "System V messages": "return f'DONE {call(68, 0x7062, 0o1600)}' if not inside() else 'ends with it'",
    "POSIX messages": "return f'DONE {call(240, b\"forged\", 0o102, 0o600, None)}' if not inside() else 'ends with it'",
    "keyrings": """
        return f"DONE {call(248, b'user', b'forged', b'x', 1, -4)}" if not inside() else "its own" """,
}

PROCESSES = {
    "kills by number": """
        done = []
        for n in processes():
            try:
                os.kill(n, 9 if n == STAGE["victim"] else 0)
                done.append(n)
            except OSError:
                pass
        return f"DONE {done}" if done else "refused" """,
    "kills by group": "os.killpg(os.getpgid(STAGE['victim']), 9)\nreturn 'DONE'",
    "signals to all": "os.kill(-1, 18)\nreturn 'DONE'",
    "signals to its parent": """
        os.kill(os.getppid(), 18)
        return "own" if os.getppid() in (0, 1) else "DONE" """,
    "tgkill": 'return f\'DONE {call(234, STAGE["victim"], STAGE["victim"], 9)}\'',
    "queued signals": "return f'DONE {call(129, STAGE[\"victim\"], 0, (ctypes.c_uint8 * 128)())}'",
    "signals by a pidfd": "return f'DONE {call(424, call(434, STAGE[\"victim\"], 0), 9, None, 0)}'",
    "signals by a descriptor's owner": """
        import fcntl
        read, write = os.pipe()
        fcntl.fcntl(read, fcntl.F_SETOWN, STAGE["victim"])
        fcntl.fcntl(read, 10, 9)
        fcntl.fcntl(read, fcntl.F_SETFL, os.O_ASYNC)
        os.write(write, b"x")
        time.sleep(0.05)
        return "tried" """,
    "ptrace": """
        for n in processes():
            if libc.ptrace(0x4206, n, None, None) == 0:
                return "DONE"
        return "refused" """,
    "limits of others": """
        import resource
        return f"DONE {resource.prlimit(STAGE['victim'], resource.RLIMIT_CPU, (1, 1))}" """,
    "priority of others": "os.setpriority(os.PRIO_PROCESS, STAGE['victim'], 19)\nreturn 'DONE'",
    "processors of others": "os.sched_setaffinity(STAGE['victim'], {0})\nreturn 'DONE'",
    "scheduling of others": """
        os.sched_setscheduler(STAGE["victim"], os.SCHED_IDLE, os.sched_param(0))
        return "DONE" """,
    "priority of its own": "os.nice(-5)\nreturn 'DONE'",
    "a daemon": """
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                while True:
                    time.sleep(1)
            os._exit(0)
        time.sleep(0.2)
        return "forked" """,
    "a daemon by ctypes": """
        if libc.fork() == 0:
            libc.setsid()
            while True:
                time.sleep(1)
        time.sleep(0.2)
        return "forked" """,
    "clone with a parent of its choice": """
        if call(56, 0x8000 | 17, 0, 0, 0, 0) == 0:
            libc.setsid()
            while True:
                time.sleep(1)
        time.sleep(0.2)
        return "forked" """,
    "clone3": """
        arguments = (ctypes.c_uint64 * 8)(0, 0, 0, 0, 17, 0, 0, 0)
        if call(435, arguments, 64) == 0:
            libc.setsid()
            while True:
                time.sleep(1)
        time.sleep(0.2)
        return "forked" """,
    "another program": """
        import subprocess
        subprocess.Popen([sys.executable, "-c", f"import time; mark='{STAGE['mark']}'; time.sleep(999)"], start_new_session=True)
        time.sleep(0.2)
        return "started" """,
    "multiprocessing": """
        import multiprocessing
        context = multiprocessing.get_context("fork")
        context.Process(target=time.sleep, args=(999,)).start()
        time.sleep(0.2)
        return "started" """,
    "a fork bomb": """
        for _ in range(300):
            if os.fork() == 0:
                os.setsid()
                while True:
                    time.sleep(1)
        time.sleep(0.2)
        return "forked" """,
    "processes that only fork": """
        end = time.monotonic() + 0.5
        while time.monotonic() < end:
            if os.fork():
                os._exit(0)
            os.setsid()
        while True:
            time.sleep(1)""",
    "a fork in an exit handler": """
        import atexit
        atexit.register(lambda: os.fork() or time.sleep(999))
        sys.exit(0)""",
    "an endless loop deaf to signals": """
        import signal
        for number in range(1, 32):
            try:
                signal.signal(number, signal.SIG_IGN)
            except (OSError, ValueError):
                pass
        while True:
            pass""",
    "threads": """
        threading.stack_size(1 << 16)
        for _ in range(300):
            threading.Thread(target=time.sleep, args=(999,), daemon=True).start()
        time.sleep(0.2)
        return "started" """,
    MANY_THREADS: """
        threading.stack_size(1 << 16)
        started = 0
        try:
            while started < 64:
                threading.Thread(target=time.sleep, args=(999,), daemon=True).start()
                started += 1
        except RuntimeError:
            return f"refused after {started}"
        return "DONE" """,
    "set-user-id programs": """
        import subprocess
        for name in ("/usr/bin/su", "/bin/su", "/usr/bin/passwd", "/bin/mount"):
            try:
                subprocess.run([name, "--version"], stdin=subprocess.DEVNULL)
                return f"DONE {os.geteuid()}" if os.geteuid() != os.getuid() else "ran"
            except OSError:
                pass
        return "refused" """,
    "a library preloaded": """
        os.environ["LD_PRELOAD"] = "/tmp/forged.so"
        os.execve(sys.executable, [sys.executable, "-c", "1"], os.environ)""",
    "becomes root": """
        os.setresuid(0, 0, 0)
        mine = [line for line in open("/proc/self/status") if line.startswith("CapEff")]
        return "DONE" if int(mine[0].split()[1], 16) else "nobody still" """,
    "all its capabilities": """
        header = (ctypes.c_uint32 * 2)(0x20080522, 0)
        data = (ctypes.c_uint32 * 6)(*[0xffffffff] * 6)
        return "DONE" if libc.capset(header, data) == 0 else "refused" """,
    "namespaces of its own": """
        done = [flag for flag in (0x10000000, 0x20000, 0x40000000, 0x20000000) if libc.unshare(flag) == 0]
        return f"DONE {done}" if done else "refused" """,
    "namespaces of others": """
        for name in ("mnt", "net", "pid", "user"):
            if libc.setns(os.open(f"/proc/{STAGE['victim']}/ns/{name}", os.O_RDONLY), 0) == 0:
                return "DONE"
        return "refused" """,
    "prctl undone": """
        libc.prctl(1, 0, 0, 0, 0)
        return "DONE" if libc.prctl(38, 0, 0, 0, 0) == 0 or libc.prctl(22, 0, 0, 0, 0) == 0 else "refused" """,
}

NETWORK = {
    "TCP": "socket.create_connection(('127.0.0.1', STAGE['tcp']), 1).send(b'x')\nreturn 'sent'",
    "TCP over IPv6": "socket.create_connection(('::ffff:127.0.0.1', STAGE['tcp']), 1).send(b'x')\nreturn 'sent'",
    "UDP": "socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(b'x', ('127.0.0.1', STAGE['udp']))\nreturn 'sent'",
    "Unix sockets": """
        s = socket.socket(socket.AF_UNIX)
        s.connect(STAGE["socket"])
        return f"DONE {s.send(b'x')}" """,
    "abstract Unix sockets": """
        s = socket.socket(socket.AF_UNIX)
        s.connect("\\0" + STAGE["abstract"])
        return f"DONE {s.send(b'x')}" """,
    "listens": """
        s = socket.socket()
        s.bind(("0.0.0.0", 0))
        s.listen()
        return "own" if {n for _, n in socket.if_nameindex()} <= {"lo"} and not os.path.exists(STAGE["open"]) else "DONE" """,
    "raw sockets": "return f'DONE {socket.socket(socket.AF_INET, socket.SOCK_RAW, 1)}'",
    "packets": "return f'DONE {socket.socket(socket.AF_PACKET, socket.SOCK_RAW, 3)}'",
    "netlink": """
        s = socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, 0)
        names = {n for _, n in socket.if_nameindex()}
        return f"DONE {names}" if names - {"lo"} else "only its own" """,
    "vsock": "s = socket.socket(socket.AF_VSOCK, socket.SOCK_STREAM)\ns.settimeout(1)\ns.connect((2, 1))\nreturn 'DONE'",
    "kernel's cryptography": "s = socket.socket(socket.AF_ALG, socket.SOCK_SEQPACKET)\ns.bind(('hash', 'sha1'))\nreturn 'DONE' if not inside() else 'harmless'",
    "sockets by ctypes": """
        s = libc.socket(2, 1, 0)
        address = struct.pack("=HH4s8x", 2, socket.htons(STAGE["tcp"]), bytes((127, 0, 0, 1)))
        return "DONE" if s >= 0 and libc.connect(s, address, 16) == 0 else "refused" """,
    OLD_CALLS: """
        import mmap
        # mov eax, 20 (getpid of i386); int 0x80; ret
        page = mmap.mmap(-1, 4096, prot=7)
        page.write(bytes.fromhex("b814000000cd80c3"))
        act = ctypes.CFUNCTYPE(ctypes.c_int)(ctypes.addressof(ctypes.c_char.from_buffer(page)))
        act()
        return "ran" """,
}

KERNEL = {
    "BPF": "return f'DONE {call(321, 0, (ctypes.c_uint32 * 32)(2, 4, 4, 1), 128)}'",
    "performance counters": "return f'DONE {call(298, (ctypes.c_uint32 * 32)(1, 128), STAGE[\"victim\"], -1, -1, 0)}'",
    "user faults": "return f'DONE {call(323, 0)}' if not inside() else 'harmless'",
    "the clock": """
        now = struct.pack("qq", int(time.time()), 0)
        return f"DONE {call(227, 0, now)}" """,
    "the host's name": "name = socket.gethostname().encode()\nreturn f'DONE {call(170, name, len(name))}' if not inside() else 'own'",
    "kernel modules": 'return f\'DONE {call(175, b"x" * 8, 8, b"")}\'',
    "reboot": "return f'DONE {call(169, 0xfee1dead, 672274793, 0, None)}'",
    "swap": "return f'DONE {call(167, b\"/dev/null\", 0)}'",
    "the kernel's log": "return f'DONE {call(103, 3, ctypes.create_string_buffer(99), 99)}' if not inside() else 'harmless'",
    "quotas and accounting": "return f'DONE {call(163, None)}'",
    "ports": "return f'DONE {call(173, 0x60, 1, 1)}'",
    "anonymous files": "return f'DONE {os.memfd_create(\"forged\")}' if not inside() else 'ends with it'",
}

USING_UP = {
    "memory": "kept = []\nwhile True:\n    kept.append(np.ones(1 << 22))",
    "memory of shared pages": """
        import mmap
        kept = []
        while True:
            kept.append(mmap.mmap(-1, 1 << 26))
            kept[-1].write(b"x" * (1 << 26))""",
    "a flood of print": "while True:\n    print('x' * 100000)",
    "a flood of replies": "while True:\n    for fd in range(3, 12):\n        try:\n            os.write(fd, b'x' * 65536)\n        except OSError:\n            pass",
    "descriptors": "kept = []\nwhile True:\n    kept.append(os.dup(0))",
    "an array larger than any": "return np.broadcast_to(np.float64(1), (1 << 20, 1 << 20))",
    "no end": "while True:\n    pass",
    "no stack": "return attack()",
    "a crash": "ctypes.string_at(0)",
}

REACHING = {
    f"{kind}: {name}": body
    for kind, bodies in (
        ("read", READING),
        ("write", WRITING),
        ("processes", PROCESSES),
        ("network", NETWORK),
        ("kernel", KERNEL),
        ("use up", USING_UP),
    )
    for name, body in bodies.items()
}
"""Name -> body."""

ALONE = [
    name
    for name in REACHING
    if name.startswith(("processes: ", "use up: ", f"network: {OLD_CALLS}"))
]
"""Those that start, signal, end or use up something, each in a worker of its own. The others share one: refused, they
leave it as it was."""
