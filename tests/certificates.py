"""Certificates for meshes, made with the openssl command."""

import shutil
import subprocess

import pytest


def certified(folder, authority, name):
    """Zenoh's configuration of a node that a new authority certifies, made with the openssl command."""

    def openssl(*words):
        subprocess.run(["openssl", *words], cwd=folder, check=True, capture_output=True)

    new = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes")
    openssl(
        "req", "-x509", *new, "-subj", f"/CN={authority}", "-keyout", f"{authority}.key", "-out", f"{authority}.pem"
    )
    openssl("req", *new, "-subj", f"/CN={name}", "-keyout", f"{name}.key", "-out", f"{name}.csr")
    (folder / "ext").write_text("subjectAltName=IP:127.0.0.1\nextendedKeyUsage=serverAuth,clientAuth\n")
    signed = ("-in", f"{name}.csr", "-CA", f"{authority}.pem", "-CAkey", f"{authority}.key", "-CAcreateserial")
    openssl("x509", "-req", *signed, "-extfile", "ext", "-out", f"{name}.pem")
    own = "".join(
        f'{side}_certificate: "{folder}/{name}.pem", {side}_private_key: "{folder}/{name}.key", '
        for side in ("listen", "connect")
    )
    tls = f'{{ root_ca_certificate: "{folder}/{authority}.pem", enable_mtls: true, {own} }}'
    file = folder / f"{name}.json5"
    file.write_text(f"{{ transport: {{ link: {{ tls: {tls} }} }} }}")
    return file


def certificates(folder):
    """Configurations of a buoy and of a stranger, each certified by an authority of its own."""
    if shutil.which("openssl") is None:
        pytest.skip("there is no openssl command to make certificates with")
    return certified(folder, "ours", "buoy"), certified(folder, "theirs", "stranger")
