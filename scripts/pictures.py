#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of rviz and of the maps for the docs: see pictures.sh.

    rviz_display.jpg  the package's own display
    rviz_markers.jpg  the same graph as markers, which any rviz shows
    rviz_panel.jpg    the window as it opens, with the panel; of a walk only, as a saved run has no times
    plan.svg          the plan of the first floor
    grid.png          its grid, as move_base would see it
"""
import argparse
import glob
import json
import os
import shutil
import subprocess
import tempfile
import time

from demo_view import bounds, camera, with_view, without_panels
from off_screen import NAMESPACE, OffScreen, wait_for

HERE = os.path.dirname(os.path.abspath(__file__))
RVIZ_FOLDER = os.path.join(HERE, '..', 'rviz')
LIFT_M = 10.0
MAX_BYTES = 300000
START_S = 10.0  # of rviz
LOOK_EVERY_S = 5.0
PATIENCE_S = 180.0  # a software renderer takes its time
ALL_BUT_THE_FRAME_RATE = '1280x760+0+0'
SCENE_ALONE = '1248x708+16+62'  # of a window without panels


def walk(screen, bag, rate, folder):
    """Plays a bag through the nodelets, which stay, and saves the run."""
    env = {name: value for name, value in screen.env.items() if name != 'ROS_NAMESPACE'}
    launch = screen.start(['roslaunch', 'mrpt_sgraphs', 'demo.launch', f'bag:={bag}',
                           f'rate:={rate}', 'rviz:=false', f'layer_lift:={LIFT_M}'], 'launch',
                          env=env)
    log = os.path.join(screen.folder, 'launch.log')

    def ended():
        if launch.poll() is not None:
            raise SystemExit(f'the launch ended before the bag did: see {log}')
        with open(log) as text:
            return 'process has finished cleanly' in text.read()

    wait_for(ended, 7200.0, 'the bag did not end')
    time.sleep(5.0)  # the last scans are still on their way
    answer = subprocess.run(['rosservice', 'call', f'/{NAMESPACE}/dump', f"folder: '{folder}'"],
                            env=env, stdout=subprocess.PIPE, text=True, check=True).stdout
    if 'success: True' not in answer:
        raise SystemExit(answer)


def view_of(run):
    with open(os.path.join(run, 'graph.json')) as text:
        graph = json.load(text)
    return camera(*bounds([p for wall in graph['walls'] for p in wall['polygon']]), LIFT_M)


def pixels(screen, shot):
    subprocess.run(['import', '-window', 'root', shot], env=screen.env, check=True)
    return subprocess.run(['convert', shot, '-crop', ALL_BUT_THE_FRAME_RATE, 'rgb:-'],
                          stdout=subprocess.PIPE, check=True).stdout


def wait_until_drawn(screen, rviz, shot):
    """Until nothing changes any more."""
    time.sleep(START_S)
    end = time.monotonic() + PATIENCE_S
    before = None
    now = pixels(screen, shot)
    while now != before and time.monotonic() < end:
        time.sleep(LOOK_EVERY_S)
        if rviz.poll() is not None:
            raise SystemExit(f'rviz ended: see {screen.folder}')
        before, now = now, pixels(screen, shot)


def picture(screen, config, out, crop=None):
    path = os.path.join(screen.folder, os.path.basename(out))
    with open(path + '.rviz', 'w') as file:
        file.write(config)
    rviz = screen.rviz(path + '.rviz', os.path.basename(out) + '.rviz')
    wait_until_drawn(screen, rviz, path + '.png')
    screen.stop(rviz)
    subprocess.run(['convert', path + '.png'] + (['-crop', crop, '+repage'] if crop else []) +
                   ['-quality', '85', out], check=True)
    size = os.path.getsize(out)
    print(f'{out}: {size // 1000} kB')
    if size > MAX_BYTES:
        raise SystemExit(f'{out} is larger than {MAX_BYTES // 1000} kB')


def maps(run, out):
    """What a run has written of its first floor."""
    plan, grid = [sorted(glob.glob(os.path.join(run, 'floor_*.' + ending)))[0]
                  for ending in ('svg', 'pgm')]
    shutil.copyfile(plan, os.path.join(out, 'plan.svg'))
    subprocess.run(['convert', grid, os.path.join(out, 'grid.png')], check=True)


def read(name):
    with open(os.path.join(RVIZ_FOLDER, name)) as text:
        return text.read()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument('--bag', help='run.bag of sgraphs_simulate')
    source.add_argument('--run', help='folder with graph.json')
    parser.add_argument('--rate', type=float, default=1.0, help='how fast the bag is played')
    parser.add_argument('--out', default=os.path.join(HERE, '..', 'docs'))
    given = parser.parse_args()
    out = os.path.abspath(given.out)
    os.makedirs(out, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, OffScreen(folder) as screen:
        run = given.run
        if run:
            screen.start(['rosrun', 'mrpt_sgraphs', 'sgraphs_publish', os.path.abspath(run),
                          f'_layer_lift_m:={LIFT_M}'], 'publish')
        else:
            run = os.path.join(folder, 'run')
            walk(screen, os.path.abspath(given.bag), given.rate, run)
        view = view_of(run)
        plugin, markers = read('sgraphs_plugin.rviz'), read('sgraphs.rviz')
        picture(screen, with_view(without_panels(plugin), view),
                os.path.join(out, 'rviz_display.jpg'), SCENE_ALONE)
        picture(screen, with_view(without_panels(markers), view),
                os.path.join(out, 'rviz_markers.jpg'), SCENE_ALONE)
        if given.bag:
            picture(screen, with_view(plugin, view), os.path.join(out, 'rviz_panel.jpg'))
        maps(run, out)


if __name__ == '__main__':
    main()
