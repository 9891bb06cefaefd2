// The `harrier` program: hands the command line to the commands.
int main() {
    return 2;
}
