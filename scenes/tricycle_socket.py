#python
# SPDX-License-Identifier: BSD-3-Clause
# TCP interface of the tricycle. A client sends lines "steering;speed" (rad; rad/s of the front wheel). The answer to
# each is a line "time;distance" (s; m, 0.00 without an echo), or "error: ..." for an invalid line.
import math
import socket

ADDRESS = ('127.0.0.1', 5000)
MOST_CLIENTS = 32
LONGEST_LINE = 200  # bytes; a command has about twenty
MOST_BYTES = 1024  # per client and simulation step
MOST_NEW = 1000  # clients per simulation step


def sysCall_init():
    self.steering = sim.getObject('/Steering')
    self.motor = sim.getObject('/FrontMotor')
    self.sonar = sim.getObject('/FrontSonar')
    self.clients = []
    try:
        # Sets SO_REUSEADDR: the next start need not wait for TIME_WAIT of the connections of this one.
        self.server = socket.create_server(ADDRESS)
    except OSError as error:
        raise OSError(f'cannot listen on {ADDRESS[0]}:{ADDRESS[1]} ({error}): is another simulation running?') from None
    self.server.setblocking(False)


def sysCall_actuation():
    for client in self.clients:
        obey(client)
    accept_clients()


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
    for _ in range(MOST_NEW):
        try:
            connection, _ = self.server.accept()
        except OSError:  # no client is waiting, or it has disconnected
            return
        client = Client(connection)
        obey(client)
        self.clients = [other for other in self.clients if other.connected]
        if len(self.clients) == MOST_CLIENTS:
            refuse_one(client)
        if client.connected:
            self.clients.append(client)


def refuse_one(new):
    """Make room: refuse the oldest client that has never sent a command, or the new one."""
    idle = [client for client in self.clients if not client.has_commanded]
    (idle or [new])[0].refuse(f'{MOST_CLIENTS} clients are connected already')
    self.clients = [client for client in self.clients if client.connected]


def obey(client):
    """Follow the commands that a client has sent since the last step."""
    for line in client.lines():
        try:
            steering, speed = parse_command(line)
        except ValueError as error:
            client.answers.append(f'error: {error}')
            continue
        sim.setJointTargetPosition(self.steering, steering)
        sim.setJointTargetVelocity(self.motor, speed)
        client.has_commanded = True
        client.answers.append(None)


def parse_command(line):
    """Return steering and speed; raise ValueError for anything else than two finite numbers."""
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
    """A non-blocking connection."""

    def __init__(self, connection):
        connection.setblocking(False)
        self.connection = connection
        self.connected = True
        self.answers = []  # to the lines of this step: an error, or None for the measurement
        self.rest = b''  # incomplete line
        self.ends_lines = False  # has sent a newline
        self.has_commanded = False

    def lines(self):
        """Return the received lines.

        Some clients send no newline and wait for an answer. If a client has never sent a newline, data that stays
        unchanged for a whole step counts as a line.
        """
        try:
            arrived = self.connection.recv(MOST_BYTES)
        except BlockingIOError:
            lonely = b'' if self.ends_lines else self.rest
            if lonely:
                self.rest = b''
            return [lonely] if lonely else []
        except OSError:  # connection reset
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
        """Send one answer to each line. Disconnect a client that does not read them."""
        answers = [answer or measured for answer in self.answers]
        self.answers = []
        if answers:
            self._write(answers)

    def refuse(self, reason):
        """Send the reason and close the connection."""
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
        except OSError:  # disconnected, or the send buffer is full
            self.close()
