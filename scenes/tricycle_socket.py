#python
# SPDX-License-Identifier: BSD-3-Clause
# The tricycle over TCP. A client sends lines "steering;speed" (rad; rad/s of the front wheel) and gets for each a line
# "time;distance" (s; m ahead, 0.00 without an echo), or "error: ..." for what it should not have sent.
import math
import socket

ADDRESS = ('127.0.0.1', 5000)
MOST_CLIENTS = 32
LONGEST_LINE = 200  # bytes; a command takes some twenty
MOST_IN_A_PASS = 1024  # bytes of a client


def sysCall_init():
    self.steering = sim.getObject('/Steering')
    self.motor = sim.getObject('/FrontMotor')
    self.sonar = sim.getObject('/FrontSonar')
    self.clients = []
    try:
        # With SO_REUSEADDR, so that the next start need not wait for the connections of this one to be forgotten.
        self.server = socket.create_server(ADDRESS)
    except OSError as error:
        raise OSError(f'cannot listen on {ADDRESS[0]}:{ADDRESS[1]} ({error}): does another simulation run?') from None
    self.server.setblocking(False)


def sysCall_actuation():
    accept_clients()
    for client in self.clients:
        for line in client.lines():
            try:
                steering, speed = parse_command(line)
            except ValueError as error:
                client.answers.append(f'error: {error}')
                continue
            sim.setJointTargetPosition(self.steering, steering)
            sim.setJointTargetVelocity(self.motor, speed)
            client.answers.append(None)


def sysCall_sensing():
    seen, distance, *_ = sim.readProximitySensor(self.sonar)
    measured = f'{sim.getSimulationTime():.3f};{distance if seen else 0.0:.2f}'
    for client in self.clients:
        client.send(measured)
    self.clients = [client for client in self.clients if client.connected]


def sysCall_cleanup():
    for client in self.clients:
        client.close()
    if hasattr(self, 'server'):
        self.server.close()


def accept_clients():
    while True:
        try:
            connection, _ = self.server.accept()
        except OSError:  # nobody waits, or who waited has gone
            return
        client = Client(connection)
        if len(self.clients) < MOST_CLIENTS:
            self.clients.append(client)
        else:
            client.refuse(f'{MOST_CLIENTS} clients are connected already')


def parse_command(line):
    """Steering and speed; ValueError for anything else than two finite numbers."""
    try:
        steering, speed = (float(number) for number in line.decode('ascii').split(';'))
    except ValueError:
        steering = speed = math.nan
    if not (math.isfinite(steering) and math.isfinite(speed)):
        raise ValueError(f"expected 'steering;speed', two numbers such as 0.5;1.0, found {shown(line)}")
    return steering, speed


def shown(line):
    return ascii(line.decode('ascii', 'backslashreplace'))


class Client:
    """A connection that is never waited for."""

    def __init__(self, connection):
        connection.setblocking(False)
        self.connection = connection
        self.connected = True
        self.answers = []  # to the lines of this step: an error each, or None for what was measured
        self.rest = b''  # of a line that has not ended yet
        self.ends_lines = False  # has sent the end of a line

    def lines(self):
        """What has arrived, line by line.

        Many clients send no end of line, but wait for an answer. Of one that never sent any, what lay here alone for
        a whole step is a line, too.
        """
        try:
            arrived = self.connection.recv(MOST_IN_A_PASS)
        except BlockingIOError:
            lonely = b'' if self.ends_lines else self.rest
            if lonely:
                self.rest = b''
            return [lonely] if lonely else []
        except OSError:  # the client has gone without a word
            arrived = b''
        if not arrived:
            self.close()
            return []
        *lines, self.rest = (self.rest + arrived).split(b'\n')
        self.ends_lines = self.ends_lines or bool(lines)
        if len(self.rest) > LONGEST_LINE:
            self.refuse(f'a line of more than {LONGEST_LINE} bytes')
            return []
        return [line for line in lines if line.strip()]

    def send(self, measured):
        """One answer to each line. A client that does not read them is let go."""
        answers = [answer or measured for answer in self.answers]
        self.answers = []
        if answers:
            self._write(answers)

    def refuse(self, reason):
        """Say why, and hang up."""
        self._write([f'error: {reason}'])
        self.close()

    def close(self):
        self.connected = False
        self.connection.close()

    def _write(self, lines):
        text = ''.join(f'{line}\n' for line in lines).encode()
        try:
            if self.connection.send(text) < len(text):
                self.close()
        except OSError:  # gone, or has not read for long
            self.close()
