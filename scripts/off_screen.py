# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""rviz where there is no screen, and a master of its own: what the pictures and the benchmark share."""
import os
import signal
import socket
import subprocess
import time

NAMESPACE = 'sgraphs'


def free_port():
    with socket.socket() as sock:
        sock.bind(('localhost', 0))
        return sock.getsockname()[1]


def wait_for(condition, timeout_s, what):
    end = time.monotonic() + timeout_s
    while not condition():
        if time.monotonic() > end:
            raise SystemExit(f'{what} within {timeout_s:.0f} s')
        time.sleep(0.1)


class OffScreen:
    """A screen without a monitor, a roscore, and programs that end with it. Logs go to `folder`."""

    def __init__(self, folder, width=1280, height=800):
        self.folder = folder
        self._running = []
        os.makedirs(folder, exist_ok=True)
        read_end, write_end = os.pipe()
        self.start(['Xvfb', '-displayfd', str(write_end), '-screen', '0', f'{width}x{height}x24',
                    '+extension', 'GLX'], 'xvfb', pass_fds=(write_end,), env=os.environ)
        os.close(write_end)
        with os.fdopen(read_end) as number:
            display = number.readline().strip()
        if not display:
            raise SystemExit(f'Xvfb did not start: see {folder}/xvfb.log')
        port = free_port()
        self.env = dict(os.environ, DISPLAY=':' + display, LIBGL_ALWAYS_SOFTWARE='1',
                        ROS_MASTER_URI=f'http://localhost:{port}', ROS_HOSTNAME='localhost',
                        ROS_HOME=os.path.join(folder, 'ros_home'), ROS_NAMESPACE=NAMESPACE)
        core = dict(self.env)
        del core['ROS_NAMESPACE']
        self.start(['roscore', '-p', str(port)], 'roscore', env=core)
        wait_for(lambda: subprocess.run(['rostopic', 'list'], env=core, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, check=False).returncode == 0,
                 60.0, 'roscore does not answer')

    def start(self, command, name, env=None, **options):
        with open(os.path.join(self.folder, name + '.log'), 'w') as log:
            process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT,
                                       env=env or self.env, **options)
        self._running.append(process)
        return process

    def rviz(self, config, name='rviz', **extra):
        return self.start(['rviz', '--display-config', config, '--fixed-frame', 'map'], name,
                          env=dict(self.env, **extra))

    def stop(self, process):
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(10.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._running.remove(process)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(list(self._running)):
            self.stop(process)
